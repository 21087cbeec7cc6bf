// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/replay_error.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <numeric>

#include "refusal.hpp"
#include "shapes.hpp"

namespace mien {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Every vertex goes `way` per row.
MeshSequence shifted(const Mesh& mesh, const Vec3f& way, std::size_t rows) {
    MeshSequence sequence{mesh, {}, {}};
    for (std::size_t r = 0; r < rows; ++r) sequence.times.push_back(static_cast<double>(r));
    sequence.positions = [mesh, way](std::size_t row, std::span<Vec3f> filled) {
        for (std::size_t v = 0; v < filled.size(); ++v) filled[v] = mesh.positions[v] + static_cast<float>(row) * way;
    };
    return sequence;
}

const std::vector<std::size_t> three_rows{0, 1, 2};

TEST(ReplayError, AShiftIsItsOwnError) {
    const Face face = shapes::mask();  // eyes 1 apart
    const MeshSequence truth = shifted(face.mesh, {0.1F, 0, 0}, 3), replay = shifted(face.mesh, {0.1F, 0.02F, 0}, 3);
    const ReplayError error = replay_error(face, truth, three_rows, replay);
    EXPECT_NEAR(error.mean, 0.02, 1e-6);
    EXPECT_NEAR(error.max, 0.04, 1e-6);
    EXPECT_NEAR(error.error, 0.2, 1e-5);
    ASSERT_EQ(error.rows.size(), 3U);
    EXPECT_NEAR(error.rows[2], 0.04, 1e-6);
    for (const double v : error.vertices) EXPECT_NEAR(v, 0.02 * std::sqrt(5.0 / 3), 1e-6);
    std::size_t vertices = 0;
    for (const ReplayRegion& region : error.regions) {
        vertices += region.vertices;
        EXPECT_NEAR(region.mean, 0.02, 1e-6) << region.name;
        EXPECT_NEAR(region.error, 0.2, 1e-5) << region.name;
    }
    EXPECT_EQ(vertices, vertex_count(face.mesh));
}

TEST(ReplayError, TheTruthHasNone) {
    const Face face = shapes::mask();
    const MeshSequence truth = shifted(face.mesh, {0.1F, 0, 0}, 3);
    const ReplayError error = replay_error(face, truth, three_rows, truth);
    EXPECT_EQ(error.max, 0);
    EXPECT_EQ(error.error, 0);
}

TEST(ReplayError, AMotionWhereThereIsNoneIsInfinitelyWrong) {
    const Face face = shapes::mask();
    const ReplayError error =
        replay_error(face, shifted(face.mesh, {}, 3), three_rows, shifted(face.mesh, {0.1F, 0, 0}, 3));
    EXPECT_TRUE(std::isinf(error.error));
}

TEST(ReplayError, SharesAreOfTheSquaresOfARegion) {
    const Face face = shapes::mask();
    const std::vector<double> part(vertex_count(face.mesh), 1), whole(vertex_count(face.mesh), 4);
    for (const double share : shares_by_region(face, part, whole)) EXPECT_DOUBLE_EQ(share, 0.25);
}

TEST(ReplayError, AFrameIsShownByTheNearestRow) {
    MeshSequence sequence{shapes::grid(1, 1), {10, 10.1, 10.2, 10.3}, {}};
    EXPECT_THAT(rows_of_frames(sequence, std::vector{0.0, 0.04, 0.06, 0.16, 0.31, 0.4}), ElementsAre(0, 0, 1, 2, 3));
    sequence.times.clear();
    EXPECT_THAT(refusal([&] { rows_of_frames(sequence, std::vector{0.0}); }), HasSubstr("found none"));
}

TEST(ReplayError, DifferentNumbersOfRowsOrVerticesAreRefused) {
    const Face face = shapes::mask();
    const MeshSequence three = shifted(face.mesh, {}, 3), two = shifted(face.mesh, {}, 2);
    EXPECT_THAT(refusal([&] { replay_error(face, three, three_rows, two); }), HasSubstr("expected 3 rows, found 2"));
    const MeshSequence other = shifted(shapes::grid(1, 1), {}, 3);
    EXPECT_THAT(refusal([&] { replay_error(face, three, three_rows, other); }), HasSubstr("vertices, found 4"));
    EXPECT_THAT(refusal([&] { replay_error(face, three, {}, three); }), HasSubstr("found none"));
}

}  // namespace
}  // namespace mien
