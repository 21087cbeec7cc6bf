// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Which islands are eyeballs. MPEG-4 turns the eyeballs (FAPs 23-26) and heads come with them as one ball, as half a
// ball that is open behind, or as nested pieces; names differ from file to file, so shape and place decide.
//
// The sphere is fitted algebraically (|p|^2 = 2 c.p + r^2 - |c|^2 is linear in c and r^2 - |c|^2), again and again with
// weights area / residual: the ball of least absolute distance.

#include "algorithms/eyeballs.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace mien {

namespace {

// Sums over points near the origin, of size about 1.
Sphere fit_once(std::span<const Vec3> points, std::span<const double> weights) {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector4d row(points[i].x, points[i].y, points[i].z, 1);
        normal += weights[i] * row * row.transpose();
        right += weights[i] * dot(points[i], points[i]) * row;
    }
    Eigen::FullPivLU<Eigen::Matrix4d> solver(normal);
    solver.setThreshold(1e-9);
    if (!solver.isInvertible()) return {};
    const Eigen::Vector4d x = solver.solve(right);
    const Vec3 centre{x[0] / 2, x[1] / 2, x[2] / 2};
    return {centre, std::sqrt(std::max(0.0, x[3] + dot(centre, centre))), 0};
}

double roughness_of(const Sphere& sphere, std::span<const Vec3> points, std::span<const double> weights) {
    double sum = 0, total = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double off = distance(points[i], sphere.centre) - sphere.radius;
        sum += weights[i] * off * off;
        total += weights[i];
    }
    return std::sqrt(sum / total) / sphere.radius;
}

}  // namespace

Sphere fit_sphere(std::span<const Vec3> points, std::span<const double> weights) {
    Vec3 mean;
    for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
    double size = 0;
    for (const Vec3& p : points) size = std::max(size, distance(p, mean));
    if (!(size > 0)) return {};
    std::vector<Vec3> near;
    for (const Vec3& p : points) near.push_back((p - mean) / size);

    std::vector<double> trust(weights.begin(), weights.end());
    Sphere sphere;
    for (int round = 0; round < 30; ++round) {
        sphere = fit_once(near, trust);
        if (!(sphere.radius > 0)) return {};
        for (std::size_t i = 0; i < near.size(); ++i)
            trust[i] = weights[i] / std::max(1e-4, std::abs(distance(near[i], sphere.centre) - sphere.radius));
    }
    sphere.roughness = roughness_of(sphere, near, weights);
    return {mean + size * sphere.centre, size * sphere.radius, sphere.roughness};
}

namespace {

// A third of the area round each place, as a fan of triangles gives it.
std::vector<double> place_areas(const Mesh& mesh, const Weld& weld) {
    std::vector<double> areas(weld.vertex.size(), 0);
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        const auto corners = face(mesh, f);
        const Vec3 a = to_double(mesh.positions[corners[0]]);
        for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
            const Vec3 ab = to_double(mesh.positions[corners[k]]) - a;
            const Vec3 ac = to_double(mesh.positions[corners[k + 1]]) - a;
            for (const std::uint32_t v : {corners[0], corners[k], corners[k + 1]})
                areas[weld.place[v]] += length(cross(ab, ac)) / 6;
        }
    }
    return areas;
}

struct Head {
    const Face& face;
    const Weld& weld;
    double scale;
    std::vector<double> areas;
    std::vector<Vec3> eyes;  // where the points say that eyes are: between corners, between lids, at pupils
};

std::vector<Vec3> eye_places(std::span<const FeaturePoint> points) {
    constexpr std::array<std::array<std::string_view, 2>, 8> pairs{{{"3.7", "3.11"},
                                                                    {"3.8", "3.12"},
                                                                    {"3.5", "3.5"},
                                                                    {"3.6", "3.6"},
                                                                    {"3.1", "3.3"},
                                                                    {"3.2", "3.4"},
                                                                    {"3.9", "3.13"},
                                                                    {"3.10", "3.14"}}};
    std::vector<Vec3> places;
    for (const auto& pair : pairs) {
        const auto a = find_point(points, pair[0]);
        const auto b = find_point(points, pair[1]);
        if (a && b) places.push_back(0.5 * (points[*a].position + points[*b].position));
    }
    return places;
}

bool holds_only_a_pupil(const Head& head, const Island& island) {
    return island.points.size() <= 1 && std::all_of(island.points.begin(), island.points.end(), [&](std::uint32_t i) {
               return head.face.points[i].id == "3.5" || head.face.points[i].id == "3.6";
           });
}

std::vector<Vec3> positions_of(const Head& head, const Island& island) {
    std::vector<Vec3> positions;
    for (const std::uint32_t p : island.places) positions.push_back(position(head.face.mesh, head.weld, p));
    return positions;
}

// The ball of an island, with radius 0 when it is none: too rough, a shallow cap, not of an eye's size, not at an eye.
Sphere ball_of(const Head& head, const Island& island) {
    const Vec3 extent = island.box.high - island.box.low;
    const double width = std::max({extent.x, extent.y, extent.z});
    if (island.places.size() < 8 || width > 1.3 * head.scale || !holds_only_a_pupil(head, island)) return {};
    std::vector<double> areas;
    for (const std::uint32_t p : island.places) areas.push_back(head.areas[p]);
    const Sphere ball = fit_sphere(positions_of(head, island), areas);
    const bool is_round = ball.radius > 0 && ball.roughness < 0.1 && width > 1.4 * ball.radius;
    const bool is_eye_sized = ball.radius > 0.08 * head.scale && ball.radius < 0.6 * head.scale;
    const bool is_at_eye = std::any_of(head.eyes.begin(), head.eyes.end(),
                                       [&](const Vec3& eye) { return distance(eye, ball.centre) < 1.5 * ball.radius; });
    return is_round && is_eye_sized && (is_at_eye || island.points.size() == 1) ? ball : Sphere{};
}

// What lies along the lids moves with them, however close to the ball.
bool lies_along_lids(std::string_view part) {
    constexpr std::array<std::string_view, 9> words{"lash", "Lash",   "brow",     "Brow",    "tear",
                                                    "Tear", "lacrim", "caruncle", "cclusion"};
    return std::any_of(words.begin(), words.end(), [&](auto word) { return part.find(word) != part.npos; });
}

bool lies_inside(const Head& head, const Island& island, const Sphere& ball) {
    if (!island.has_faces || !holds_only_a_pupil(head, island) || lies_along_lids(island.part)) return false;
    const auto positions = positions_of(head, island);
    return std::all_of(positions.begin(), positions.end(),
                       [&](const Vec3& p) { return distance(p, ball.centre) < 1.15 * ball.radius; });
}

}  // namespace

std::vector<EyeballIslands> find_eyeballs(const Face& face, const Weld& weld, std::span<const Island> islands) {
    const Head head{face, weld, face_scale(face), place_areas(face.mesh, weld), eye_places(face.points)};
    std::vector<std::pair<Sphere, std::uint32_t>> balls;
    for (std::uint32_t i = 0; i < islands.size(); ++i)
        if (const Sphere ball = ball_of(head, islands[i]); ball.radius > 0) balls.emplace_back(ball, i);
    // The largest first: it takes in the shells inside it.
    std::stable_sort(balls.begin(), balls.end(),
                     [](const auto& a, const auto& b) { return a.first.radius > b.first.radius; });

    std::vector<EyeballIslands> eyeballs;
    std::vector<bool> taken(islands.size(), false);
    for (const auto& [ball, i] : balls) {
        if (taken[i]) continue;
        taken[i] = true;
        EyeballIslands eyeball{ball, {i}};
        for (std::uint32_t j = 0; j < islands.size(); ++j)
            if (!taken[j] && lies_inside(head, islands[j], ball)) {
                taken[j] = true;
                eyeball.islands.push_back(j);
            }
        eyeballs.push_back(eyeball);
    }
    std::sort(eyeballs.begin(), eyeballs.end(),
              [](const auto& a, const auto& b) { return a.islands.front() < b.islands.front(); });
    return eyeballs;
}

std::optional<Vec3> middle_of_eyes(std::span<const FeaturePoint> points) {
    Vec3 sum;
    std::size_t count = 0;
    for (const FeaturePoint& point : points)
        if (point.id.starts_with("3.")) {
            sum += point.position;
            ++count;
        }
    return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

}  // namespace mien
