// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mien/face.hpp"
#include "mien/prior.hpp"
#include "mien/take.hpp"

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
    std::optional<Prior> prior;   ///< of a rig made from example shapes: what they add to the rows
};

inline std::size_t vertex_count(const Rig& rig) {
    return rig.rest.size();
}

/// How far one point moves each vertex: of its weights along x, y and z the one of largest size. Zero where it has
/// none.
std::vector<float> weights_of(const Rig& rig, std::size_t point);

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

/// Two lid points of one eye, on the margins or on the borders of the lids, which slide over its eyeball: see
/// `displacements`.
struct LidsOverEye {
    std::size_t upper = 0, lower = 0;  ///< rig points; the same one where the face has only one of them
    Vec3 centre;                       ///< of the eyeball
};

/// Two inner lip points that may meet but not cross: see `displacements`.
struct LipsThatMeet {
    std::size_t upper = 0, lower = 0;  ///< rig points
    Vec3 up;                           ///< from the lower lip to the upper, of length 1
};

/// Where the columns of a take land on a rig's points.
struct TakeBinding {
    std::vector<std::int32_t> columns;  ///< one per rig point: its column in the take, or -1: it keeps still
    std::vector<std::string> missing;   ///< rig points that the take does not drive
    std::vector<std::string> unused;    ///< take columns that the rig does not have
    std::vector<LidsOverEye> lids;      ///< of eyes whose eyeball the rig knows
    std::vector<LipsThatMeet> lips;
};
TakeBinding bind_take(const Rig& rig, const Take& take);

/// Displacements of the rig's points in one row of a take that was retargeted to this face. A lost sample keeps its
/// point at neutral for that row. `displacements`: one per rig point, filled.
///
/// Lids slide: a way along a straight line from open to closed would lead through the eyeball. A lid point that would
/// come nearer to the eye's centre than the lids are at rest is put back outwards; between the upper and the lower
/// lid's direction from the centre that distance passes from the one's to the other's, so that lids that meet still do.
/// Inner lips press: where the outer lips come so near that the inner ones would pass each other, those meet halfway.
void displacements(const Rig& rig, const TakeBinding& binding, std::span<const Vec3> row,
                   std::span<Vec3f> displacements) noexcept;

/// The turn of an eyeball that keeps its centre: the shortest one that brings the rig point that aims it to where that
/// point was displaced to. No turn without such a point, or when the point falls on the centre.
Quaternion eyeball_turn(const Rig& rig, const Eyeball& eyeball, std::span<const Vec3f> displacements) noexcept;

/// Joints of a skin of this rig: its points, the still joint, its eyeballs.
inline std::size_t joint_count(const Rig& rig) {
    return rig.points.size() + 1 + rig.eyeballs.size();
}

/// Where joint `joint` rests: at its feature point, at the origin (the still joint), at the centre of its eyeball.
Vec3 joint_origin(const Rig& rig, std::size_t joint) noexcept;

/// How far each joint of a skin moves and turns from its rest when the rig's points are displaced; a vertex p that
/// hangs on joint j alone goes to origin_j + apply(pose_j, p - origin_j). A point that is constrained along an axis is
/// carried there by the points near it, so its joint moves as its vertex does. `poses`: one per joint, filled.
void joint_poses(const Rig& rig, std::span<const Vec3f> displacements, std::span<Pose> poses) noexcept;

}  // namespace mien
