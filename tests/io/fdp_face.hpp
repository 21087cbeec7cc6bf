// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A face definition with everything that its files hold.

#pragma once

#include "mien/fdp.hpp"

namespace mien {

// Two triangles of skin with a seam in their texture, and an eye of one triangle in a head that turns.
inline Fdp small_face() {
    Fdp fdp;
    Mesh& mesh = fdp.mesh;
    mesh.unit = "m";
    mesh.positions = {{0.1F, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, -0.3F}, {3, 3, 1}, {4, 3, 1}, {3, 4, 1}, {9, 9, 9}};
    const std::vector<std::vector<std::uint32_t>> faces{{0, 1, 2}, {2, 1, 3}, {4, 5, 6}};
    for (const auto& corners : faces) add_face(mesh, corners);
    mesh.corner_uvs = {{0, 0}, {1, 0}, {0, 0.7F}, {0.25F, 0.7F}, {1, 0}, {0.1F, 0.2F}, {0.3F, 1}, {0, 0}, {0.5F, 0.1F}};
    mesh.parts = {{"skin", 0, 0, 0, 8, 0, 2}, {"left eye", 1, 0, 0, 8, 2, 1}};
    fdp.points = {{"2.1", 0, {0.1F, 0, 0}, {}, 0}, {"3.5", 4, {3, 3, 1}, {}, 0}, {"11.4", 2, {0, 1, 0}, {}, 0}};
    fdp.fapu.irisd = 0.0123;
    fdp.fapu.es = 0.0621;
    fdp.fapu.ens = 0.0417;
    fdp.fapu.mns = 1.0 / 3;
    fdp.fapu.mw = 0.0511;
    fdp.fat.nodes = {{"left eye", {4, 5, 6}, {3.5, 3.5, 1.0 / 7}}, {"head", {0, 1, 2, 3, 4, 5, 6, 7}, {0, -1, 0}}};
    fdp.fat.tables = {
        {1, 4, {{{0, 63}, {2}, {{0.1F, 0.2F, 1e-9F}}}}, {}},
        {3,
         0,
         {{{-500, 0, 100, 900},
           {0, 7},
           {{0, -1e-5F, 0}, {0, -3.1e-5F, 1e-7F}, {0.1F, 1.0F / 3, 0}, {-0.0F, 1, 2}, {3, 4, 5}, {6e-7F, 7, 8}}}},
         {}},
        {23, 0, {}, {{0, TransformField::rotation, {0, 1, 0}, 1e-5, {}, {}}}},
        {29, 0, {}, {{0, TransformField::scale, {0, 0, 1}, 0, {}, {0.0123 / 1024, 0, 0}}}},
        {49,
         0,
         {},
         {{1, TransformField::rotation, {0, 1, 0}, 1e-5, {}, {}},
          {1, TransformField::translation, {0, 0, 1}, 0, {0, 1e-5, 0}, {}}}}};
    return fdp;
}

inline bool operator==(const FaceDefMesh& a, const FaceDefMesh& b) {
    return a.borders == b.borders && a.vertices == b.vertices && a.displacements == b.displacements;
}
inline bool operator==(const FaceDefTransform& a, const FaceDefTransform& b) {
    return a.node == b.node && a.field == b.field && a.axis == b.axis && a.angle == b.angle &&
           a.translation == b.translation && a.scale == b.scale;
}
inline bool operator==(const FaceDefTables& a, const FaceDefTables& b) {
    return a.fap == b.fap && a.high_level_select == b.high_level_select && a.meshes == b.meshes &&
           a.transforms == b.transforms;
}
inline bool operator==(const FatNode& a, const FatNode& b) {
    return a.name == b.name && a.vertices == b.vertices && a.centre == b.centre;
}
inline bool operator==(const Fat& a, const Fat& b) {
    return a.nodes == b.nodes && a.tables == b.tables;
}

}  // namespace mien
