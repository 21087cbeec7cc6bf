// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mien/colour.hpp"
#include "mien/draw/annotate.hpp"
#include "mien/picture.hpp"

namespace mien {

// Sheets of paper with pictures on them. A sheet has a margin all around; from the top it holds the title and the note,
// where there are any, the rows of pictures, and the legend. Every cell is as large as the widest and the highest
// picture; a smaller one is centred in it. Captions are broken into lines of the cell's width and stand below their
// picture; a row keeps room for as many lines as its longest caption has. Pictures that are not opaque show the paper.

struct SheetOptions {
    std::uint32_t columns =
        0;                   ///< of a contact sheet; 0 chooses what brings it near the shape 3:2 with few empty cells
    std::string title = {};  ///< above all, in larger, heavier letters
    std::string note = {};   ///< below the title, in grey: what the sheet shows and how it was made
    std::optional<Legend> legend = {};  ///< below all, centred
    std::uint32_t margin = 24;          ///< around all, in pixels
    std::uint32_t gap = 12;             ///< between cells, in pixels
    double text_size = 13;              ///< of captions and names, in pixels; titles follow it
    Colour paper = {250, 249, 247};
    Colour ink = {40, 40, 44};
};

/// Lays pictures in rows with a caption below each: key frames of a take, the shapes of a morph set. Captions may be
/// none at all; a line break in one is kept. Throws Error when there is no picture, when there are captions but not one
/// for each picture, when a picture's bytes do not fit its size, or when the sheet would be wider or higher than 32767
/// pixels.
Picture contact_sheet(std::span<const Picture> pictures, std::span<const std::string> captions,
                      const SheetOptions& options = {});

/// Two pictures side by side, as a contact sheet of two columns.
Picture beside(const Picture& left, const Picture& right, std::span<const std::string> captions,
               const SheetOptions& options = {});

struct GridNames {
    std::vector<std::string> rows = {};     ///< to the left of each row: what is compared
    std::vector<std::string> columns = {};  ///< above each column: by whom
    std::vector<std::string> cells = {};    ///< below each picture, row by row: how it did; may be none at all
};

/// Lays pictures, row by row, in a table with named rows and columns: shapes by methods with their errors in colour.
/// Throws Error when there are not rows x columns pictures, and as `contact_sheet` does; `options.columns` is not used.
Picture grid(std::span<const Picture> pictures, const GridNames& names, const SheetOptions& options = {});

}  // namespace mien
