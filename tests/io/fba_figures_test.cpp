// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Rate against distortion for a real capture, printed: markers, head motion taken out, the performer's own units, FAPs
// at 25 frames a second, coded, decoded, played on the performer again.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <iostream>
#include <string>

#include "mien/algorithms/faps.hpp"
#include "mien/algorithms/fapu.hpp"
#include "mien/algorithms/head.hpp"
#include "mien/io/fba.hpp"
#include "mien/io/read.hpp"

namespace mien {
namespace {

struct Distortion {
    double mean = 0, most = 0;  // root mean square and largest, in the unit of the takes
};

// Over the lips and the chin.
Distortion mouth_distortion(const Take& a, const Take& b) {
    Distortion distortion;
    std::size_t count = 0;
    for (std::size_t c = 0; c < a.points.size(); ++c) {
        if (!a.points[c].starts_with("8.") && !a.points[c].starts_with("2.")) continue;
        for (std::size_t r = 0; r < row_count(a); ++r, ++count) {
            const double far = distance(row(a, r)[c], row(b, r)[c]);
            distortion.mean += far * far;
            distortion.most = std::max(distortion.most, far);
        }
    }
    distortion.mean = std::sqrt(distortion.mean / static_cast<double>(std::max<std::size_t>(count, 1)));
    return distortion;
}

TEST(FbaFigures, ARealJawIsWithinTwoPercentOfTheMouthAtFourKilobitsPerSecond) {
    const std::filesystem::path folder = std::filesystem::path(MIEN_SHARED) / "data/markers-41";
    if (!std::filesystem::exists(folder / "jaw.trc")) GTEST_SKIP() << "the capture is not there";
    const Take captured = rename_points(read_take(folder / "jaw.trc"), read_marker_map(folder / "markers-to-fdp.json"));
    const Take face = remove_head_motion(captured);
    const Fapu fapu = measure_fapu(points_of_row(face, 0));
    for (const std::string& sentence : fapu.estimated) std::cout << sentence << "\n";
    const FapStream stream = to_faps(face, fapu, {.rate = 25});
    const Take before = to_take(stream, fapu);
    std::cout << fmt::format("{} frames, {} FAPs, mouth {:.2f} wide\nquant kbit/s rms % of MW  most %\n",
                             stream.frames.size(), stream.frames[0].mask.count(), fapu.mw);
    bool good = false;
    for (const int quant : {1, 2, 3, 4, 6, 8, 10, 12, 16, 20, 24, 31}) {
        const EncodedFaps encoded = format_fba(stream, {.quant = quant});
        const Distortion d = mouth_distortion(before, to_take(encoded.decoded, fapu));
        std::cout << fmt::format("{:5} {:6.2f} {:11.2f} {:8.2f}  clamped {}\n", quant, encoded.kilobits_per_second,
                                 100 * d.mean / fapu.mw, 100 * d.most / fapu.mw, encoded.clamped);
        good = good || (encoded.kilobits_per_second <= 4 && d.most <= 0.02 * fapu.mw);
    }
    EXPECT_TRUE(good);
}

}  // namespace
}  // namespace mien
