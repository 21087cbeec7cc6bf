// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mien/vec.hpp"

namespace mien::samples {

struct Uv {
    double u = 0, v = 0;
};

/// Linear colour, 0 to 1 per channel.
struct Colour {
    double r = 1, g = 1, b = 1, a = 1;
};

struct Material {
    std::string name;
    Colour colour;
    double roughness = 0.6;
    std::string picture{};  ///< name of the picture that colours it, or nothing
    bool two_sided = false;
};

/// What a face of the skin shows; it decides the vertex colours.
enum class Region : std::uint8_t { skin, lid_margin, lip, inner_mouth };

inline constexpr std::uint32_t no_vertex = 0xffffffffU;

/// A quad, or a triangle whose fourth corner is `no_vertex`; counter-clockwise seen from outside.
struct SurfaceFace {
    std::array<std::uint32_t, 4> corners{};
    std::array<Uv, 4> uvs{};
    std::uint32_t material = 0;  ///< index into the surface's materials
    Region region = Region::skin;
};

inline std::size_t corner_count(const SurfaceFace& face) {
    return face.corners[3] == no_vertex ? 3 : 4;
}

/// One part of the sample head. Millimetres; +x the subject's left, +y up, +z out of the face, y = 0 at the pupils, z =
/// 0 at the ear canals.
struct Surface {
    std::string name;
    std::vector<Vec3> positions;
    std::vector<SurfaceFace> faces;
    std::vector<Material> materials;
    std::vector<Colour> colours;  ///< empty, or one per vertex
};

/// The mirror image at x = 0, under another name.
Surface mirrored(const Surface& surface, const std::string& name);

/// A half joined with its mirror image; vertices at x = 0 are shared.
Surface joined_with_mirror(const Surface& half);

/// Per vertex, of length 1, weighted by area.
std::vector<Vec3> vertex_normals(const Surface& surface);

/// Rounds positions to a thousandth of a millimetre, so that the last bits of sin and cos do not show in the files.
void round_positions(Surface& surface);

}  // namespace mien::samples
