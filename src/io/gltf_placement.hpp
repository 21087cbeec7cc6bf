// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "io/glb.hpp"

#include "mien/vec.hpp"

namespace mien {

/// The linear part of a placement, by columns.
struct Linear {
    std::array<Vec3, 3> columns{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

    friend Vec3 operator*(const Linear& m, const Vec3& v) {
        return v.x * m.columns[0] + v.y * m.columns[1] + v.z * m.columns[2];
    }
};

double determinant(const Linear& m);

/// What turns normals where `m` turns points: the inverse transpose times |det m|, which needs no division.
Linear normal_map(const Linear& m);

/// How a mesh of a document stands in its scene.
class Placement {
public:
    Placement() = default;
    explicit Placement(const Linear& world) : world_(world) {}

    [[nodiscard]] const Linear& linear(std::size_t /*vertex*/) const { return world_; }
    [[nodiscard]] bool mirrors() const { return determinant(world_) < 0; }

private:
    Linear world_;
};

/// One per mesh of the document: by the first node of the scene that shows it, depth first; as it is where none does.
std::vector<Placement> mesh_placements(const GltfDocument& document, std::size_t scene);

/// Turns the triangles of a primitive round: strips and fans become lists. Points and lines stay.
void turn_triangles(GltfDocument& document, nlohmann::json& primitive, std::size_t vertices);

}  // namespace mien
