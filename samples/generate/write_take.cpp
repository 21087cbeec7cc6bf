// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <fmt/format.h>
#include <iterator>

#include "performance.hpp"

namespace mien::samples {

std::string format_trc_take(const Take& take) {
    const std::size_t rows = row_count(take), columns = take.points.size();
    std::string text =
        "PathFileType\t4\t(X/Y/Z)\ttake.trc\n"
        "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n";
    fmt::format_to(std::back_inserter(text), "60.00\t60.00\t{}\t{}\t{}\t60.00\t1\t{}\nFrame#\tTime", rows, columns,
                   take.unit, rows);
    for (const std::string& name : take.points) fmt::format_to(std::back_inserter(text), "\t{}\t\t", name);
    text += "\n\t";
    for (std::size_t c = 1; c <= columns; ++c) fmt::format_to(std::back_inserter(text), "\tX{}\tY{}\tZ{}", c, c, c);
    text += "\n\n";
    for (std::size_t r = 0; r < rows; ++r) {
        fmt::format_to(std::back_inserter(text), "{}\t{:.5f}", r + 1, take.times[r]);
        for (const Vec3& p : row(take, r))
            if (is_finite(p))
                fmt::format_to(std::back_inserter(text), "\t{:.3f}\t{:.3f}\t{:.3f}", p.x + 0.0, p.y + 0.0, p.z + 0.0);
            else
                text += "\t\t\t";
        text += "\n";
    }
    return text;
}

std::string format_names(const Performance& performance) {
    std::string text = "marker,id\n";
    for (const Rename& name : performance.names)
        fmt::format_to(std::back_inserter(text), "{},{}\n", name.from, name.to);
    return text;
}

}  // namespace mien::samples
