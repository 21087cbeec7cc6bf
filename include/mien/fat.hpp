// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mien/fap.hpp"
#include "mien/vec.hpp"

namespace mien {

/// How vertices move with the value of one parameter: FaceDefMesh of ISO/IEC 14496-1. The offset is piecewise linear in
/// the value and zero at zero; beyond the outermost borders the outermost interval goes on.
struct FaceDefMesh {
    std::vector<std::int32_t> borders;    ///< FAP units, ascending, two or more, one of them 0
    std::vector<std::uint32_t> vertices;  ///< ascending; indices into the positions of the head
    /// Per vertex one vector for each of the borders - 1 intervals, all of the first vertex first: how far the vertex
    /// goes per FAP unit while the value passes through the interval upwards, in the head's unit.
    std::vector<Vec3f> displacements;
};

/// What a FaceDefTransform changes of its node.
enum class TransformField { translation, rotation, scale };

/// How a part of the head moves as a whole with the value f of one parameter: FaceDefTransform of ISO/IEC 14496-1.
/// Turns and scales are about the node's centre.
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

/// All that one parameter moves, or one viseme (FAP 1) or expression (FAP 2): FaceDefTables of ISO/IEC 14496-1.
struct FaceDefTables {
    int fap = 0;                ///< 1 to 68
    int high_level_select = 0;  ///< for FAPs 1 and 2: which viseme or expression, from 1; else 0
    std::vector<FaceDefMesh> meshes;
    std::vector<FaceDefTransform> transforms;
};

/// A face animation table: how every vertex of one head follows the parameters. Offsets of all parameters add, and all
/// act on the neutral head; transforms act after them, in the order of the tables, translations last.
struct Fat {
    std::vector<FatNode> nodes;
    std::vector<FaceDefTables> tables;  ///< ascending by (fap, high_level_select), each pair once
};

}  // namespace mien
