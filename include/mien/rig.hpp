// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mien/face.hpp"

namespace mien {

/// An island of the mesh that turns about its own centre: an eyeball.
struct Eyeball {
    std::string name;
    std::vector<std::uint32_t> vertices;  ///< ascending
    Vec3 centre;                          ///< in the mesh's unit
    std::optional<std::uint32_t>
        point;  ///< the rig point on the pupil that aims it (3.5, 3.6); nothing: it keeps still
};

/// How one island without skin points was attached, for the report.
struct Attachment {
    std::string name;  ///< the part's name, or "island 3"
    std::string how;   ///< "turns about its centre", "follows the jaw", "follows the skull", "follows the skin"
    std::uint32_t vertices = 0;
};

/// How feature points move a head: for every vertex a short row of (point, weight), fixed at bind time. Every rigger
/// returns a Rig and one `deform` serves all, because eq. 5 of Kshirsagar et al. and the skinning sum of Dutreve et al.
/// are both fixed linear weights: position_v = rest_v + sum_k weight_k * displacement(point_k), per axis.
///
/// Weights may be negative and rows need not sum to 1: what is left over stays still.
struct Rig {
    std::string method;  ///< name of the rigger that made it ("biharmonic")
    std::vector<FeaturePoint> points;
    std::vector<Vec3f> rest;                ///< one per vertex of the head's file, in file order
    std::vector<std::uint32_t> row_starts;  ///< vertices + 1 entries; vertex v has entries row_starts[v] .. [v+1]-1
    std::vector<std::uint16_t> row_points;  ///< index into `points`, ascending within a row
    std::vector<Vec3f> weights;             ///< one per entry of `row_points`: the weight along x, y and z
    std::vector<Eyeball> eyeballs;          ///< their vertices have empty rows
    std::vector<Attachment> attachments;
    std::uint32_t unreached = 0;  ///< skin vertices that no feature point reaches: they do not move
};

inline std::size_t vertex_count(const Rig& rig) {
    return rig.rest.size();
}

/// The rig as every engine knows it: a fixed number of joints per vertex with weights that are non-negative and sum
/// to 1. Joint j < points is feature point j and only translates; joint number `points.size()` stands still; joints
/// after it are the eyeballs in order, which turn. Heaviest joint first; unused slots hold joint 0 with weight 0.
struct Skin {
    std::uint32_t influences = 4;       ///< slots per vertex: a multiple of 4
    std::vector<std::uint16_t> joints;  ///< vertices x influences
    std::vector<float> weights;         ///< vertices x influences
    double mean_error = 0;              ///< root mean square distance to what the rig gives over the take it was
    double max_error = 0;               ///< measured with, and the largest such distance, in the mesh's unit
};

}  // namespace mien
