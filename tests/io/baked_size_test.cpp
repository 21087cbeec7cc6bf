// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/baked_size.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <sstream>

#include "refusal.hpp"
#include "shapes.hpp"

#include "mien/io/point_cache.hpp"

namespace mien {
namespace {

MeshSequence wave(float height, std::size_t rows) {
    MeshSequence sequence{shapes::grid(20, 20), {}, {}};
    for (std::size_t r = 0; r < rows; ++r) sequence.times.push_back(static_cast<double>(r));
    sequence.positions = [mesh = sequence.mesh, height](std::size_t row, std::span<Vec3f> filled) {
        for (std::size_t v = 0; v < filled.size(); ++v) {
            const float phase = 0.7F * static_cast<float>(v * v % 97) + static_cast<float>(row);
            filled[v] = mesh.positions[v] + Vec3f{0, 0, height * std::sin(phase)};
        }
    };
    return sequence;
}

TEST(BakedSize, AnMddIsAsLargeAsItsFile) {
    const MeshSequence sequence = wave(1, 5);
    std::ostringstream out;
    format_mdd(sequence, out);
    EXPECT_EQ(baked_size(sequence, {}).point_cache, out.str().size());
}

TEST(BakedSize, EveryRowThatMovesCostsAndRestCostsNextToNothing) {
    const std::size_t moving = baked_size(wave(1, 20), {}).morph_per_row,
                      longer = baked_size(wave(1, 40), {}).morph_per_row;
    const std::size_t still = baked_size(wave(0, 20), {}).morph_per_row;
    EXPECT_GT(moving, 4 * still);
    EXPECT_GT(longer, moving + 8000);
}

TEST(BakedSize, ATrackCostsItsTargetsOnce) {
    const MeshSequence sequence = wave(1, 30);
    MorphTrack track;
    track.targets.push_back({"a", {0, 1, 2}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
    track.times = sequence.times;
    track.weights.assign(30, 0.5F);
    const BakedSize size = baked_size(sequence, track);
    EXPECT_LT(size.morph_track, size.morph_per_row);
    EXPECT_GT(size.morph_track, baked_size(sequence, {}).morph_track);
    MorphTrack one;
    one.targets = track.targets;
    MorphTrack two = one;
    two.targets.push_back(one.targets.front());
    const std::size_t none = baked_size(sequence, {}).morph_track, single = baked_size(sequence, one).morph_track;
    EXPECT_GT(single, none);
    EXPECT_EQ(baked_size(sequence, two).morph_track - none, 2 * (single - none));
}

TEST(BakedSize, APositionThatIsNoNumberIsRefused) {
    MeshSequence sequence = wave(1, 2);
    sequence.positions = [](std::size_t, std::span<Vec3f> filled) {
        for (Vec3f& p : filled) p = {std::numeric_limits<float>::quiet_NaN(), 0, 0};
    };
    EXPECT_THAT(refusal([&] { baked_size(sequence, {}); }), testing::HasSubstr("finite"));
}

}  // namespace
}  // namespace mien
