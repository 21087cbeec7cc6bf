// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// From the motion d of n points to every vertex, with example shapes e_k (docs/methods.md, "From example shapes"):
//
//     S    how places move together (prior_kernel.cpp), P = (S_ff + noise)^-1, weights W = S P, cut by refitting
//     E_k  the shapes, evened out: sigma_k e_k; X their motion at the points
//     H = X'PX + (r/v) I, K = X'P, c = H^-1 K d, or where shapes may only be added the minimiser of c'Hc/2 - (Kd)'c
//     u = sum_k c_k E_k + W (d - X c)  =  W d + sum_k c_k (E_k - W X_k)
//
// The second form is what a rig holds, with c in whole shapes e_k: the points then move the rows just as in any other
// rig, and vertices at points are moved by no shape. W is per axis where points are constrained; H and K sum over axes.

#include "mien/algorithms/rig_prior.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string>

#include "algorithms/island.hpp"
#include "algorithms/movers.hpp"
#include "algorithms/prior_kernel.hpp"
#include "algorithms/refit.hpp"

#include "mien/algorithms/attach.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

constexpr double smallest_shape = 1e-3;  // of the mean: smaller ones are noise on the skin
constexpr double smallest_delta = 1e-5;  // eye distances

PriorSetting own_setting(std::size_t points, bool one_sided) {
    const bool many = points >= 60;
    return {28.5, 0.2, 0.5, 0.2, 0.7, 0.7, 0.8, many ? 0.01 : 0.1, 0.2, 1e-4, one_sided ? 0.3 : 1, many ? 0.1 : 0.3};
}
constexpr PriorSetting carried_setting{41, 1, 0.08, 0.5, 0.5, 0, 0.7, 0.005, 0.3, 1e-4, 1, 0};

void check_shape(const MorphTarget& shape, std::size_t vertices) {
    if (shape.vertices.size() != shape.deltas.size())
        throw Error(fmt::format("shape \"{}\": expected a motion for each of {} vertices, found {}", shape.name,
                                shape.vertices.size(), shape.deltas.size()));
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
        if (shape.vertices[i] >= vertices)
            throw Error(fmt::format("shape \"{}\": expected vertices below {}, found {}", shape.name, vertices,
                                    shape.vertices[i]));
        if (!is_finite(shape.deltas[i]))
            throw Error(fmt::format("shape \"{}\": expected finite numbers, found another at vertex {}", shape.name,
                                    shape.vertices[i]));
    }
}

Field field_of(const MorphTarget& shape, const Ground& ground) {
    check_shape(shape, vertex_count(ground.face.mesh));
    Field field = Field::Zero(std::ssize(ground.joined.vertex), 3);
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
        const std::uint32_t place = ground.joined.place[shape.vertices[i]];
        if (!ground.solved[place] || ground.joined.vertex[place] != shape.vertices[i]) continue;
        const Vec3 delta = to_double(shape.deltas[i]) / ground.scale;
        field.row(place) << delta.x, delta.y, delta.z;
    }
    return field;
}

// Shapes that move the skin, and which of the given ones they are.
struct Skinned {
    std::vector<Field> fields;
    std::vector<const MorphTarget*> shapes;
};

Skinned that_move_skin(const std::vector<MorphTarget>& shapes, const Ground& ground) {
    std::vector<Field> fields;
    double mean = 0;
    for (const MorphTarget& shape : shapes) {
        fields.push_back(field_of(shape, ground));
        mean += std::sqrt(squared_size(fields.back())) / static_cast<double>(shapes.size());
    }
    Skinned kept;
    for (std::size_t k = 0; k < shapes.size(); ++k) {
        if (!(std::sqrt(squared_size(fields[k])) > smallest_shape * mean)) continue;
        kept.fields.push_back(std::move(fields[k]));
        kept.shapes.push_back(&shapes[k]);
    }
    return kept;
}

// What one set of movers leads to.
struct Solved {
    std::vector<std::uint16_t> points;
    Eigen::MatrixXd precision;  // P
    WeightRows rows;
};

// Every solved place but those of the movers.
std::vector<std::uint32_t> free_places(const Ground& ground, const Movers& movers) {
    std::vector<bool> is_free(ground.solved);
    for (const std::uint32_t place : movers.places) is_free[place] = false;
    std::vector<std::uint32_t> places;
    for (std::uint32_t p = 0; p < is_free.size(); ++p)
        if (is_free[p]) places.push_back(p);
    return places;
}

Solved solved_of(const Ground& ground, const Movers& movers, const Learnt& learnt, const PriorSetting& setting,
                 std::uint32_t influences) {
    Solved part{movers.points, {}, {}};
    if (movers.points.empty()) {
        part.rows.starts.assign(ground.solved.size() + 1, 0);
        return part;
    }
    const Eigen::MatrixXd S = kernel(ground, movers, learnt, setting);
    const std::vector<Eigen::Index> at(movers.places.begin(), movers.places.end());
    Eigen::MatrixXd block = S(at, Eigen::all);
    block = ((block + block.transpose()) / 2).eval();
    block.diagonal().array() += setting.eps * (block.diagonal().mean() + setting.v / 3);
    const Eigen::Index n = block.rows();
    part.precision = block.llt().solve(Eigen::MatrixXd::Identity(n, n));
    const std::vector<std::uint32_t> free = free_places(ground, movers);
    const Eigen::MatrixXd weights = S(free, Eigen::all) * part.precision;
    part.rows = refit_rows(ground.solved.size(), movers, free, weights, block, influences);
    return part;
}

// H and K; the columns of K are those of the rig's points, x y z each.
struct Normal {
    Eigen::MatrixXd H, K;
};

Normal normal_equations(const Ground& ground, std::span<const Field> shapes, const std::vector<double>& factors,
                        const std::vector<Solved>& parts, const PriorSetting& setting) {
    const Eigen::Index m = std::ssize(shapes);
    Normal normal{setting.r / setting.v * Eigen::MatrixXd::Identity(m, m),
                  Eigen::MatrixXd::Zero(m, 3 * std::ssize(ground.face.points))};
    for (int axis = 0; axis < 3; ++axis) {
        const auto part = std::find_if(parts.begin(), parts.end(), [&](const Solved& each) {
            for (std::size_t i = 0; i < ground.face.points.size(); ++i) {
                const FeaturePoint& point = ground.face.points[i];
                const bool moves = ground.solved[ground.joined.place[point.vertex]] && moves_along(point, axis);
                if (moves != std::binary_search(each.points.begin(), each.points.end(), static_cast<std::uint16_t>(i)))
                    return false;
            }
            return true;
        });
        if (part == parts.end() || part->points.empty()) continue;
        Eigen::MatrixXd X(std::ssize(part->points), m);
        for (Eigen::Index i = 0; i < X.rows(); ++i)
            for (Eigen::Index k = 0; k < m; ++k)
                X(i, k) = factors[k] * shapes[k](ground.joined.place[ground.face.points[part->points[i]].vertex], axis);
        const Eigen::MatrixXd K = X.transpose() * part->precision;
        normal.H += K * X;
        for (Eigen::Index i = 0; i < X.rows(); ++i) normal.K.col(3 * part->points[i] + axis) += K.col(i);
    }
    return normal;
}

// Response and stiffness in whole shapes: c' = sigma / scale c.
void fill_solve(Prior& prior, const Normal& normal, const std::vector<double>& factors, double scale, bool one_sided) {
    const Eigen::MatrixXd H = (normal.H + normal.H.transpose()) / 2;
    const Eigen::MatrixXd response = H.llt().solve(normal.K);
    const Eigen::Index m = H.rows();
    for (Eigen::Index k = 0; k < m; ++k)
        for (Eigen::Index i = 0; i < response.cols(); i += 3)
            prior.response.push_back(factors[k] / scale * Vec3{response(k, i), response(k, i + 1), response(k, i + 2)});
    if (!one_sided) return;
    for (Eigen::Index k = 0; k < m; ++k)
        for (Eigen::Index j = 0; j < m; ++j) prior.stiffness.push_back(H(k, j) / (factors[k] * factors[j]));
}

std::vector<Vec3f> dense(const MorphTarget& shape, std::size_t vertices) {
    std::vector<Vec3f> moves(vertices);
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) moves[shape.vertices[i]] = shape.deltas[i];
    return moves;
}

// What the rows make of a shape's own points, taken from the shape.
Vec3f left_over(const Rig& rig, std::uint32_t v, const std::vector<Vec3f>& shape) {
    Vec3 left = to_double(shape[v]);
    for (std::uint32_t e = rig.row_starts[v]; e < rig.row_starts[v + 1]; ++e) {
        const Vec3 w = to_double(rig.weights[e]), d = to_double(shape[rig.points[rig.row_points[e]].vertex]);
        left -= Vec3{w.x * d.x, w.y * d.y, w.z * d.z};
    }
    return to_float(left);
}

// Which vertices a shape says something about: skin, and other islands that some example moves. No eyeballs.
std::vector<bool> shaped_vertices(const Rig& rig, const Ground& ground, const std::vector<std::vector<Vec3f>>& shapes) {
    std::vector<bool> shaped(vertex_count(rig));
    const std::vector<std::uint32_t> island = islands(ground.face.mesh, ground.joined);
    std::vector<bool> moves(vertex_count(rig) + 1);
    for (std::uint32_t v = 0; v < shaped.size(); ++v)
        for (const std::vector<Vec3f>& shape : shapes)
            if (shape[v] != Vec3f{}) moves[island[ground.joined.place[v]]] = true;
    for (std::uint32_t v = 0; v < shaped.size(); ++v)
        shaped[v] = ground.solved[ground.joined.place[v]] || moves[island[ground.joined.place[v]]];
    for (const Eyeball& eyeball : rig.eyeballs)
        for (const std::uint32_t v : eyeball.vertices) shaped[v] = false;
    return shaped;
}

// Islands that no example moves take shapes from the skin just as they take weights: shapes ride along as weights of
// points behind the rig's own.
Rig attached_shapes(const Rig& rig, const Ground& ground, const std::vector<std::vector<Vec3f>>& left) {
    Rig riding;
    riding.points = rig.points;
    riding.rest = rig.rest;
    riding.row_starts.assign(1, 0);
    for (std::uint32_t v = 0; v < vertex_count(rig); ++v) {
        for (std::size_t k = 0; k < left.size() && ground.solved[ground.joined.place[v]]; ++k) {
            riding.row_points.push_back(static_cast<std::uint16_t>(rig.points.size() + k));
            riding.weights.push_back(static_cast<float>(1 / ground.scale) * left[k][v]);
        }
        riding.row_starts.push_back(static_cast<std::uint32_t>(riding.row_points.size()));
    }
    attach_islands(riding, ground.face, ground.joined);
    return riding;
}

void take_attached(std::vector<std::vector<Vec3f>>& left, const Rig& rig, const Ground& ground,
                   const std::vector<bool>& shaped) {
    if (std::find(shaped.begin(), shaped.end(), false) == shaped.end()) return;
    const Rig riding = attached_shapes(rig, ground, left);
    for (std::uint32_t v = 0; v < vertex_count(rig); ++v)
        for (std::uint32_t e = riding.row_starts[v]; e < riding.row_starts[v + 1] && !shaped[v]; ++e)
            if (riding.row_points[e] >= rig.points.size())
                left[riding.row_points[e] - rig.points.size()][v] =
                    static_cast<float>(ground.scale) * riding.weights[e];
}

void fill_shapes(Prior& prior, const Rig& rig, const Ground& ground, std::span<const MorphTarget* const> shapes) {
    std::vector<std::vector<Vec3f>> whole, left;
    for (const MorphTarget* shape : shapes) whole.push_back(dense(*shape, vertex_count(rig)));
    const std::vector<bool> shaped = shaped_vertices(rig, ground, whole);
    for (const std::vector<Vec3f>& shape : whole) {
        left.emplace_back(vertex_count(rig));
        for (std::uint32_t v = 0; v < vertex_count(rig); ++v)
            if (shaped[v]) left.back()[v] = left_over(rig, v, shape);
    }
    take_attached(left, rig, ground, shaped);
    for (std::size_t k = 0; k < left.size(); ++k) {
        MorphTarget target{shapes[k]->name, {}, {}};
        for (std::uint32_t v = 0; v < vertex_count(rig); ++v) {
            if (!(length(left[k][v]) > smallest_delta * ground.scale)) continue;
            target.vertices.push_back(v);
            target.deltas.push_back(left[k][v]);
        }
        prior.shapes.push_back(std::move(target));
    }
}

void check_count(const Skinned& shapes, std::size_t points) {
    if (shapes.shapes.empty()) throw Error("rig prior: expected an example shape that moves the skin, found none");
    if (shapes.shapes.size() > Prior::most_shapes)
        throw Error(fmt::format("rig prior: expected at most {} example shapes, found {}", Prior::most_shapes,
                                shapes.shapes.size()));
    if (shapes.shapes.size() + points > std::numeric_limits<std::uint16_t>::max())
        throw Error(fmt::format("rig prior: expected at most {} points, found {}",
                                std::numeric_limits<std::uint16_t>::max() - shapes.shapes.size(), points));
}

}  // namespace

Rig rig_prior(const Face& face, const Examples& examples, const PriorOptions& options) {
    const Ground ground = ground_of(face);
    const Skinned own = that_move_skin(examples.own, ground), carried = that_move_skin(examples.carried, ground);
    const bool has_own = !own.shapes.empty(), one_sided = has_own && options.one_sided;
    const Skinned& known = has_own ? own : carried;
    check_count(known, face.points.size());
    const PriorSetting setting = has_own ? own_setting(ground.points.size(), one_sided) : carried_setting;
    const std::vector<Field> helpers = has_own ? carried.fields : std::vector<Field>();
    const Learnt learnt = learn(ground, known.fields, helpers, setting);

    std::vector<Solved> parts;
    Rig rig = rig_by_axes("prior", face, [&](const Weld&, const std::vector<bool>&, const Movers& movers) {
        parts.push_back(solved_of(ground, movers, learnt, setting, options.influences));
        return parts.back().rows;
    });
    Prior prior;
    const std::vector<double> factors = evening_factors(known.fields, ground.points, setting.beta);
    fill_solve(prior, normal_equations(ground, known.fields, factors, parts, setting), factors, ground.scale,
               one_sided);
    fill_shapes(prior, rig, ground, known.shapes);
    rig.prior = std::move(prior);
    return rig;
}

}  // namespace mien
