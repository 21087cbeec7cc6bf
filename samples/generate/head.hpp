// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <string>
#include <vector>

#include "character.hpp"
#include "surface.hpp"

#include "mien/picture.hpp"

namespace mien::samples {

/// An MPEG-4 feature point of the sample head: a vertex of one of its parts.
struct HeadPoint {
    std::string id;
    std::size_t part = 0;
    std::uint32_t vertex = 0;
};

struct NamedPicture {
    std::string name;
    Picture picture;
};

struct Head {
    std::string name;  ///< stem of its files
    std::string title;
    std::vector<Surface>
        parts;  ///< head, eye_left, eye_right, teeth_upper, teeth_lower, tongue, eyebrows, eyelashes, hair
    std::vector<HeadPoint> points;
    std::vector<NamedPicture> pictures;  ///< those that the parts' materials name
};

Head make_head(const Character& character);

Vec3 place(const Head& head, const HeadPoint& point);

}  // namespace mien::samples
