// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mien/take.hpp"

namespace mien {

/// What is odd about a take, for reports: nothing of it stops the work.
struct TakeCheck {
    struct Column {
        std::string point;
        std::size_t lost = 0;         ///< lost samples
        std::size_t longest_gap = 0;  ///< rows
    };
    struct Swap {
        std::string a, b;     ///< two columns whose labels seem swapped
        std::size_t row = 0;  ///< first row of the swap
    };
    std::vector<Column> lost;             ///< columns with lost samples
    std::vector<std::string> never_seen;  ///< columns lost in every row
    std::vector<Swap> swaps;              ///< jumps over half the distance of two markers in one row
};
TakeCheck check_take(const Take& take);

/// Marks as lost the samples that are exactly 0, 0, 0 in a column that is elsewhere: the habit of some capture systems.
Take mark_zeros_lost(const Take& take);

/// The same take without the columns that are lost in every row.
Take drop_never_seen(const Take& take);

struct GapOptions {
    double longest = 0.5;  ///< seconds; longer gaps stay open
};
struct GapReport {
    std::size_t filled = 0, left = 0;  ///< samples
};
/// Fills gaps between seen samples with a cubic Hermite curve in time; with enough seen round the gap, a track that
/// is a cubic comes back exactly. A gap lasts from its first lost row to the next seen one. Gaps at the ends stay open.
Take fill_gaps(const Take& take, const GapOptions& options, GapReport* report = nullptr);

struct LowPassOptions {
    double cutoff = 8;  ///< Hz at half power; below half the frame rate
};
/// Smooths every track without shifting it in time: a second-order Butterworth filter run forwards and backwards, on
/// evenly resampled stretches between gaps. Throws Error if the cut-off is not between 0 and half the frame rate.
Take low_pass(const Take& take, const LowPassOptions& options);

/// Which row, or rows, show the performer's neutral face.
struct NeutralOptions {
    std::size_t row = 0;   ///< first row of the neutral
    std::size_t rows = 1;  ///< rows averaged, lost samples left out
};
/// The neutral position of every column; a column lost in all of those rows takes its nearest seen sample in time, and
/// one that is never seen stays lost.
/// Throws Error if the rows are not in the take.
std::vector<Vec3> neutral(const Take& take, const NeutralOptions& options = {});

}  // namespace mien
