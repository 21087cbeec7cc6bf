// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The points alone: a capture becomes motion of a head's feature points. usage: 03_retarget_points HEAD POINTS TAKE MAP
// OUT.csv

#include <cstdio>

#include "mien/algorithms/head.hpp"
#include "mien/algorithms/retarget.hpp"
#include "mien/algorithms/tracks.hpp"
#include "mien/error.hpp"
#include "mien/io/read.hpp"
#include "mien/io/write.hpp"

int main(int argc, char** argv) try {
    if (argc != 6) return std::fputs("usage: 03_retarget_points HEAD POINTS TAKE MAP OUT.csv\n", stderr), 2;
    const mien::Face face = mien::read_face(argv[1], argv[2]);
    mien::Take take = mien::rename_points(mien::read_take(argv[3]), mien::read_marker_map(argv[4]));

    // Clean the capture: short gaps are filled, jitter goes, the head stands still.
    mien::GapReport gaps;
    take = mien::remove_head_motion(mien::low_pass(mien::fill_gaps(take, {.longest = 0.5}, &gaps), {.cutoff = 10}));

    const mien::Retarget map = mien::fit_retarget(take, face);
    mien::write(mien::retarget(map, take), argv[5], {.overwrite = true});
    std::printf("%zu points, %zu samples filled, %zu still lost\n", map.points.size(), gaps.filled, gaps.left);
} catch (const mien::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
