// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <span>
#include <string>
#include <string_view>

#include "mien/colour.hpp"
#include "mien/picture.hpp"
#include "mien/vec.hpp"

namespace mien {

// Text, lines and dots over a picture, all antialiased. Places are in pixels from the picture's upper left corner, x to
// the right and y down; the middle of the first pixel is (0.5, 0.5). What falls outside is cut off, and what has a
// place that is not finite or beyond a million pixels is not drawn. Letters are DejaVu Sans where it is installed.

enum class Align { left, middle, right };

struct LabelStyle {
    double size = 13;           ///< of the letters, in pixels: what printers call the em
    bool bold = false;          ///< heavier letters
    Align align = Align::left;  ///< which end of the text lies at the place
    Colour ink = {40, 40, 44};  ///< of the letters
    Colour halo = {255, 255, 255,
                   0};  ///< a rim around the letters that parts them from a busy picture; none by alpha 0
};

/// Writes one line of UTF-8 text whose capitals are centred on the height of `at`.
void draw_label(Picture& picture, Vec2f at, std::string_view text, const LabelStyle& style = {});

/// How wide that line is, in pixels.
double label_width(std::string_view text, const LabelStyle& style = {});

struct LineStyle {
    double width = 1.5;  ///< in pixels
    Colour ink = {40, 40, 44};
};

/// Draws a straight line with round ends.
void draw_line(Picture& picture, Vec2f from, Vec2f to, const LineStyle& style = {});

struct MarkerStyle {
    double radius = 3.5;                ///< in pixels, rim included
    Colour fill = {232, 93, 47};        ///< of the dot
    Colour rim = {255, 255, 255, 230};  ///< a ring of a third of the radius
};

/// Draws a dot with its middle at `at`.
void draw_marker(Picture& picture, Vec2f at, const MarkerStyle& style = {});

struct PointsStyle {
    MarkerStyle marker = {};
    LabelStyle label = {.size = 10.5, .halo = {255, 255, 255, 215}};
};

/// Marks named points, feature points with their ids for one: a dot at each place and its name beside it, on the first
/// of eight sides where it covers neither a dot nor a name before it; to the right where all are taken. Throws Error
/// when there are not as many names as places.
void draw_points(Picture& picture, std::span<const Vec2f> places, std::span<const std::string> names,
                 const PointsStyle& style = {});

/// What the colours of a scale mean: a bar from `low` at its left to `high` at its right.
struct Legend {
    double low = 0, high = 1;
    std::string unit = {};            ///< written behind the high value: "mm from the truth"
    double width = 180, height = 10;  ///< of the bar, in pixels
    ColourScale scale = ColourScale::heat;
};

/// Draws the bar with its upper left corner at `at` (rounded to a pixel), the low value before it and the high one with
/// the unit behind it.
void draw_legend(Picture& picture, Vec2f at, const Legend& legend, const LabelStyle& style = {});

}  // namespace mien
