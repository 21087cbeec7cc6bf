// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/gltf_pictures.hpp"

#include "mien/scene.hpp"
#include "mien/vec.hpp"

namespace mien {

/// Where on a picture a vertex lies: by which set of texture coordinates, and how these are changed first
/// (KHR_texture_transform).
struct PictureMapping {
    std::uint64_t set = 0;
    std::array<double, 2> offset{0, 0}, scale{1, 1};
    double rotation = 0;  ///< radians
    friend bool operator==(const PictureMapping&, const PictureMapping&) = default;
};
Vec2f mapped(const PictureMapping& mapping, const Vec2f& uv);

/// A material of a document, with the one mapping of all its pictures.
struct DocumentMaterial {
    Material material;
    PictureMapping mapping;
    bool repeats = true;  ///< whether its pictures go on beyond their edges as they began
    std::string title;    ///< "material 3 'skin'"
};

/// Reads a material. What of it is not shown is said in `pictures.left_out`. Throws Error naming the JSON pointer,
/// expected and found.
DocumentMaterial read_material(Pictures& pictures, std::size_t number);

/// What a primitive without a material has (specification, 3.7.2.1).
Material material_of_none();

}  // namespace mien
