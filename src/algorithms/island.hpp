// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mien/algorithms/weld.hpp"
#include "mien/face.hpp"

namespace mien {

/// A connected piece of the welded head.
struct Island {
    std::string part;                   ///< name of the part that its faces belong to; may be empty
    std::vector<std::uint32_t> places;  ///< ascending
    std::vector<std::uint32_t> points;  ///< the face's feature points that lie on it
    Box box;
    bool has_faces = false;
};

/// All islands, numbered as `islands` numbers them.
std::vector<Island> list_islands(const Face& face, const Weld& weld);

/// Where a place lies.
inline Vec3 position(const Mesh& mesh, const Weld& weld, std::uint32_t place) {
    return to_double(mesh.positions[weld.vertex[place]]);
}

/// The length that "near" and "small" are measured by: the eye distance, or a quarter of the head's diagonal when the
/// points give none.
double face_scale(const Face& face);

}  // namespace mien
