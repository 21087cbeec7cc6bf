// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mien {

/// A curve over x; where x or y is not finite the curve has a gap, and a value between two gaps is a dot.
struct Curve {
    std::string name;
    std::vector<double> x, y;  ///< equally many
};

/// A plot of curves: displacements, FAPs or errors over time.
struct Plot {
    std::string title = {};
    std::string x_label = {};  ///< "time in s"
    std::string y_label = {};  ///< "error in mm"
    std::vector<Curve> curves = {};
    std::uint32_t width = 960, height = 400;  ///< of the whole, in pixels of a screen, 160 to 16384
};

/// The plot as a standalone SVG file. The x axis spans the values exactly, with its ticks inside; the y axis ends at
/// ticks that enclose the values, and begins at zero where zero is nearer to them than they are spread. Names stand in
/// a legend at the right, in the order of the curves, as many as fit. Equal plots give equal bytes.
///
/// Ticks step by 1, 2 or 5 times a power of ten (P. S. Heckbert, "Nice numbers for graph labels", Graphics Gems, 1990);
/// the colours are M. Okabe and K. Ito's, which the colour-blind tell apart ("Color universal design", 2008), and
/// return dashed.
///
/// Throws Error naming the curve when it has not as many x as y or a finite value beyond 1e100, and at a size out of
/// range.
std::string format_plot(const Plot& plot);

}  // namespace mien
