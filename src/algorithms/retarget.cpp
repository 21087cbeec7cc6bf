// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Section 4 of Dutreve et al. writes T_f = F(S_f). Here a sample goes to t_i + F(s_f) - F(s_i), which is the same
// number where F(s_i) = t_i; with one linear map per point, to t_i + A_i (s_f - s_i).

#include "mien/algorithms/retarget.hpp"

#include <fmt/format.h>
#include <optional>
#include <span>
#include <utility>

#include "algorithms/face_frame.hpp"
#include "algorithms/retarget_contact.hpp"
#include "algorithms/retarget_fapu.hpp"
#include "algorithms/retarget_local.hpp"
#include "algorithms/retarget_rbf.hpp"
#include "algorithms/rotation.hpp"
#include "algorithms/similarity.hpp"
#include "algorithms/small_mouth.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

// Ids, s_i and t_i of the points that are on the face and seen in the take, in the face's order.
Retarget shared_points(const Take& take, const Face& face, const NeutralOptions& options) {
    Retarget map;
    map.planar = take.planar;
    const std::vector<Vec3> source = neutral(take, options);
    for (const FeaturePoint& point : face.points) {
        const std::optional<std::size_t> column = find_column(take, point.id);
        if (!column || !is_finite(source[*column])) continue;
        const Vec3 s = source[*column];
        map.points.push_back(point.id);
        map.source_neutral.push_back(take.planar ? Vec3{s.x, s.y, 0} : s);
        map.target_neutral.push_back(point.position);
    }
    if (map.points.empty())
        throw Error(
            fmt::format("retarget: expected feature points that the take and the face share, found none among {} "
                        "columns of the take and {} points of the face; is a marker map missing?",
                        take.points.size(), face.points.size()));
    return map;
}

// Equal centres make eq. 3 singular, and a solver need not notice: their rows are looked for before.
void refuse_coinciding(const std::vector<std::string>& ids, std::span<const Vec3> points, const char* where) {
    const double nearest = 1e-6 * diagonal(bounding_box(points));
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i + 1; j < points.size(); ++j)
            if (!(distance(points[i], points[j]) > nearest))
                throw Error(
                    fmt::format("retarget: expected points at different places, found {} and {} at the same place "
                                "({:g} {:g} {:g}) of the {}; leave one of them out",
                                ids[i], ids[j], points[i].x, points[i].y, points[i].z, where));
}

}  // namespace

Retarget fit_retarget(const Take& take, const Face& face, const RetargetOptions& options) {
    Retarget map = shared_points(take, face, options.neutral);
    refuse_coinciding(map.points, map.source_neutral, "take's neutral");
    refuse_coinciding(map.points, map.target_neutral, "face");
    if (options.reading == Reading::paper || options.method == RetargetMethod::rbf) {
        options.reading == Reading::paper ? fit_as_written(map) : fit_with_affine(map);
        for (const Vec3& s : map.source_neutral) map.at_rest.push_back(retarget(map, s));
        return map;
    }
    const FaceFrames frames = face_frames(map, eye_distance(face.points));
    fit_local_affine(map, frames);
    fit_small_mouth(map, frames);
    if (options.method == RetargetMethod::fapu) fit_fapu(map, frames, take, face, options.neutral);
    if (options.contact) fit_contact(map, frames, face.points, options.sealed);
    return map;
}

namespace {

std::vector<std::size_t> columns_of(const Retarget& map, const Take& take) {
    std::vector<std::size_t> columns;
    for (const std::string& id : map.points) {
        const std::optional<std::size_t> column = find_column(take, id);
        if (!column)
            throw Error(
                fmt::format("retarget: expected a column {} in the take, as the map was fitted with one; found none "
                            "among its {} columns",
                            id, take.points.size()));
        columns.push_back(*column);
    }
    return columns;
}

// The same motion of the head as the target makes it: back through the similarity, the pose, and forth again.
Pose pose_on_target(const Similarity& map, const Pose& pose) {
    const Quaternion rotation = map.rotation * pose.rotation * conjugate(map.rotation);
    return {rotation, apply(map, apply(pose, map.from)) - rotate(rotation, map.to)};
}

// From the sample's place to the target's motion, without what the neutral itself maps to.
Vec3 motion(const Retarget& map, std::size_t i, const Vec3& p) noexcept {
    if (map.local.empty()) return retarget(map, p) - map.at_rest[i];
    const Vec3 d = p - map.source_neutral[i];
    return d.x * map.local[i][0] + d.y * map.local[i][1] + (map.planar ? 0 : d.z) * map.local[i][2];
}

}  // namespace

void retarget(const Retarget& map, std::span<const Vec3> source, std::span<Vec3> target) noexcept {
    for (std::size_t i = 0; i < source.size(); ++i)
        target[i] = is_finite(source[i]) ? motion(map, i, source[i]) : lost_sample;
    keep_contact(map, source, target);
    for (std::size_t i = 0; i < source.size(); ++i) target[i] += map.target_neutral[i];
}

Take retarget(const Retarget& map, const Take& take) {
    const std::vector<std::size_t> columns = columns_of(map, take);
    Take result{map.points, take.times, {}, {}, {}, false, take.repeated_rows};
    result.samples.resize(row_count(take) * columns.size());
    std::vector<Vec3> source(columns.size());
    for (std::size_t r = 0; r < row_count(take); ++r) {
        for (std::size_t i = 0; i < columns.size(); ++i) source[i] = row(take, r)[columns[i]];
        retarget(map, source, row(result, r));
    }
    const Similarity base = best_similarity(map);
    for (const Pose& pose : take.head) result.head.push_back(pose_on_target(base, pose));
    return result;
}

}  // namespace mien
