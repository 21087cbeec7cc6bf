// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mien/fap.hpp"
#include "mien/vec.hpp"

namespace mien {

/// How vertices move with the value of one parameter: FaceDefMesh of ISO/IEC 14496-1. The offset is piecewise linear in
/// the value and zero at zero; beyond the outermost borders the outermost interval goes on. Below zero the value is
/// negative and so is every step through an interval: a linear table has one vector on both sides of zero.
struct FaceDefMesh {
    std::vector<std::int32_t> borders;    ///< FAP units, ascending, two or more, one of them 0
    std::vector<std::uint32_t> vertices;  ///< ascending; indices into the positions of the head
    /// Per vertex one vector for each of the borders - 1 intervals, all of the first vertex first: how far the vertex
    /// goes per FAP unit while the value passes through the interval upwards, in the head's unit.
    std::vector<Vec3f> displacements;
};

/// What a FaceDefTransform changes of its node.
enum class TransformField { translation, rotation, scale };

/// How a part of the head moves as a whole with the value of one parameter: FaceDefTransform of ISO/IEC 14496-1. Turns
/// and scales are about the node's centre.
struct FaceDefTransform {
    std::uint32_t node = 0;  ///< index into `Fat::nodes`
    TransformField field = TransformField::rotation;
    Vec3 axis{0, 0, 1};  ///< of a rotation, length 1
    double angle = 0;    ///< of a rotation: radians per FAP unit, right-handed
    Vec3 translation;    ///< in the head's unit per FAP unit
    Vec3 scale;          ///< per FAP unit, added to 1
};

/// A part of the head that transforms act on: an eyeball, the jaw's teeth, the head.
struct FatNode {
    std::string name;
    std::vector<std::uint32_t> vertices;  ///< ascending
    Vec3 centre;                          ///< in the head's unit
};

/// All that one parameter moves, or one viseme (FAP 1) or expression (FAP 2): FaceDefTables of ISO/IEC 14496-1. The
/// value of a viseme is its share of the blend in 63rds, that of an expression its intensity, 0 to 63.
struct FaceDefTables {
    int fap = 0;                ///< 1 to 68
    int high_level_select = 0;  ///< for FAPs 1 and 2: which viseme or expression, from 1; else 0
    std::vector<FaceDefMesh> meshes;
    std::vector<FaceDefTransform> transforms;
};

/// A face animation table: how every vertex of one head follows the parameters. Offsets of all parameters add, and all
/// act on the neutral head. Transforms act after them, one node after the other: what a node did goes on with one that
/// holds it, so an eyeball comes before the head. At one node the scale comes first, then turns, then the translation;
/// turns are by the parameters of roll first, pitch then and yaw last, as those of the head are; others come before.
struct Fat {
    std::vector<FatNode> nodes;
    std::vector<FaceDefTables> tables;  ///< ascending by (fap, high_level_select), each pair once
};

/// Throws Error unless the table is what the comments here say and fits a head of so many vertices: indices in range
/// and ascending, borders ascending with one zero, a vector per vertex and interval, finite numbers, axes of length 1.
void check_fat(const Fat& fat, std::size_t vertices);

}  // namespace mien
