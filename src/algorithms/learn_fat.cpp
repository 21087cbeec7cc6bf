// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The face animation table of an animation: Laftsidis et al., section 2.2. As written: learn_fat_written.cpp. The
// remedied reading is told in fat_shares.cpp; here it is laid out from the animation and put together as a table.

#include "mien/algorithms/learn_fat.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "algorithms/fap_columns.hpp"
#include "algorithms/fat_shares.hpp"
#include "algorithms/island.hpp"
#include "algorithms/learn_fat_written.hpp"
#include "algorithms/rigid_parts.hpp"

#include "mien/algorithms/extract_faps.hpp"
#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/algorithms/surface_distance.hpp"
#include "mien/algorithms/weld.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

constexpr double moves_at_all = 1e-6;  // of the eye distance
// Shares that move a vertex less are dropped: of the eye distance, of how far the parameter's point goes if that is
// less, but never below the last, of the eye distance again.
constexpr double seen = 2e-3, seen_of_point = 0.05, unseen = 5e-4;

using Index = Eigen::Index;

// The welded head, and the places that move with the skin.
struct Ground {
    Face face;
    Weld weld;
    EdgeGraph graph;
    double scale = 0;
    std::vector<std::uint32_t> places;    // ascending
    std::vector<std::uint32_t> vertices;  // one per entry of `places`
};

Ground prepare(const UprightSequence& upright, const FapColumns& columns, const std::vector<MovingEyeball>& eyeballs) {
    Ground ground{{upright.sequence.mesh, upright.points}, {}, {}, 0, {}, {}};
    ground.weld = weld(ground.face.mesh);
    ground.graph = edge_graph(ground.face.mesh, ground.weld);
    ground.scale = face_scale(ground.face);
    const std::vector<Vec3f>& rest = ground.face.mesh.positions;
    std::vector<bool> moves(rest.size(), false);
    std::vector<Vec3f> row(rest.size());
    for (const std::size_t r : columns.rows) {
        upright.sequence.positions(r, row);
        for (std::size_t v = 0; v < rest.size(); ++v)
            if (distance(row[v], rest[v]) > moves_at_all * ground.scale) moves[v] = true;
    }
    for (const MovingEyeball& eyeball : eyeballs)
        for (const std::uint32_t v : eyeball.vertices) moves[v] = false;
    for (std::uint32_t p = 0; p < ground.weld.vertex.size(); ++p)
        if (moves[ground.weld.vertex[p]]) {
            ground.places.push_back(p);
            ground.vertices.push_back(ground.weld.vertex[p]);
        }
    return ground;
}

// From a place along the surface, or through the air to pieces that the surface does not reach.
std::vector<double> distances_from(const Ground& ground, std::uint32_t vertex) {
    const std::uint32_t source = ground.weld.place[vertex];
    const std::vector<double> all = surface_distances(ground.graph, source);
    const Vec3 from = position(ground.face.mesh, ground.weld, source);
    std::vector<double> result;
    for (const std::uint32_t p : ground.places)
        result.push_back((std::isfinite(all[p]) ? all[p] : distance(from, position(ground.face.mesh, ground.weld, p))) /
                         ground.scale);
    return result;
}

Vec3 axis_of(const Fap& fap) {
    switch (fap.axis) {
        case FapAxis::x:
            return {1.0 * fap.sign, 0, 0};
        case FapAxis::y:
            return {0, 1.0 * fap.sign, 0};
        case FapAxis::z:
            return {0, 0, 1.0 * fap.sign};
        default:
            return {};
    }
}

// The default rig of the face; nothing where it cannot be made.
std::optional<Rig> rig_of(const Face& face) {
    try {
        return rig_biharmonic(face);
    } catch (const Error&) {
        return std::nullopt;
    }
}

// What the rig does with the point of a parameter at one unit.
std::vector<Vec3> rig_field(const Rig& rig, const Ground& ground, std::size_t point, const Vec3& move) {
    std::vector<Vec3> field;
    for (const std::uint32_t v : ground.vertices) {
        Vec3 here;
        for (std::uint32_t e = rig.row_starts[v]; e < rig.row_starts[v + 1]; ++e)
            if (rig.row_points[e] == point) {
                const Vec3 w = to_double(rig.weights[e]);
                here = {w.x * move.x, w.y * move.y, w.z * move.z};
            }
        field.push_back(here);
    }
    return field;
}

Expectation expect(const Ground& ground, const Fapu& fapu, const FapColumns& columns, const Model& model) {
    constexpr double far = 1e3;  // a parameter without a point of the face is far from everything
    const auto intervals = static_cast<Index>(model.intervals.size());
    const auto places = static_cast<Index>(ground.places.size());
    Expectation expectation{Eigen::MatrixXd::Zero(intervals, 3 * places),
                            Eigen::MatrixXd::Constant(intervals, places, far),
                            Eigen::VectorXd::Constant(intervals, seen * ground.scale)};
    const std::optional<Rig> rig = rig_of(ground.face);
    for (std::size_t k = 0; k < columns.faps.size(); ++k) {
        const Fap& fap = fap_info(columns.faps[k]);
        const auto point = find_point(ground.face.points, fap.point);
        if (!point) continue;
        const std::vector<double> away = distances_from(ground, ground.face.points[*point].vertex);
        const Vec3 move = unit_length(fapu, fap.unit) * axis_of(fap);
        const double farthest = columns.values.col(static_cast<Index>(k)).cwiseAbs().maxCoeff();
        const std::vector<Vec3> field =
            rig ? rig_field(*rig, ground, *point, move) : std::vector<Vec3>(ground.places.size());
        for (Index i = 0; i < intervals; ++i) {
            if (model.intervals[static_cast<std::size_t>(i)].column != k) continue;
            if (length(move) > 0)
                expectation.least[i] =
                    std::clamp(seen_of_point * farthest * length(move), unseen * ground.scale, seen * ground.scale);
            for (Index p = 0; p < places; ++p) {
                expectation.distances(i, p) = away[static_cast<std::size_t>(p)];
                const Vec3 w = model.sizes[i] * field[static_cast<std::size_t>(p)];
                expectation.fields.block(i, 3 * p, 1, 3) << w.x, w.y, w.z;
            }
        }
    }
    return expectation;
}

// The intervals of one parameter and the values it took.
struct Course {
    std::vector<Index> intervals;
    std::vector<std::int32_t> borders;
};

Course course_of(const FapColumns& columns, const Model& model, std::size_t column) {
    Course course;
    const auto values = columns.values.col(static_cast<Index>(column));
    const auto low = static_cast<std::int32_t>(std::min(values.minCoeff(), 0.0));
    const auto high = static_cast<std::int32_t>(std::max(values.maxCoeff(), 0.0));
    for (std::size_t i = 0; i < model.intervals.size(); ++i) {
        const Interval& interval = model.intervals[i];
        if (interval.column != column) continue;
        course.intervals.push_back(static_cast<Index>(i));
        if (course.borders.empty())
            course.borders.push_back(static_cast<std::int32_t>(std::max<double>(interval.low, low)));
        course.borders.push_back(static_cast<std::int32_t>(std::min<double>(interval.high, high)));
    }
    // Plainly linear: one interval that goes on to the other side of 0.
    if (course.intervals.size() == 1) course.borders = -low > high ? std::vector{low, 0} : std::vector{0, high};
    return course;
}

// To a thousandth of the parameter's unit: finer steps would be lost in the rounding of its values, and short numbers
// make small files.
Vec3f short_step(const Vec3& step, int fap, const Fapu& fapu) {
    constexpr double fine = 1000;
    const double unit = unit_length(fapu, fap_info(fap).unit);
    if (fap_info(fap).unit == FapUnit::angle || !(unit > 0)) return to_float(step);
    const auto rounded = [&](double x) { return std::round(fine * x / unit) / fine * unit; };
    return to_float({rounded(step.x), rounded(step.y), rounded(step.z)});
}

FaceDefMesh mesh_of(const Ground& ground, const Fapu& fapu, int fap, const Model& model, const Eigen::MatrixXd& shares,
                    const Course& course) {
    FaceDefMesh mesh;
    mesh.borders = course.borders;
    std::vector<Index> place_index(ground.weld.vertex.size(), -1);
    for (std::size_t p = 0; p < ground.places.size(); ++p) place_index[ground.places[p]] = static_cast<Index>(p);
    for (std::uint32_t v = 0; v < ground.weld.place.size(); ++v) {
        const Index p = place_index[ground.weld.place[v]];
        if (p < 0) continue;
        std::vector<Vec3f> steps;
        for (const Index i : course.intervals)
            steps.push_back(short_step(
                Vec3{shares(i, 3 * p), shares(i, 3 * p + 1), shares(i, 3 * p + 2)} / model.sizes[i], fap, fapu));
        if (std::all_of(steps.begin(), steps.end(), [](const Vec3f& step) { return step == Vec3f{}; })) continue;
        mesh.vertices.push_back(v);
        mesh.displacements.insert(mesh.displacements.end(), steps.begin(), steps.end());
    }
    return mesh;
}

// Which parameters the eyeballs and the head follow as a whole.
struct EyeFaps {
    std::string_view pupil;
    int yaw, pitch, thrust;
};
constexpr std::array<EyeFaps, 2> eye_faps{{{"3.5", 23, 25, 27}, {"3.6", 24, 26, 28}}};
constexpr std::array head_faps{48, 49, 50};

std::vector<int> transform_faps(const std::vector<MovingEyeball>& eyeballs) {
    std::vector<int> numbers(head_faps.begin(), head_faps.end());
    for (const MovingEyeball& eyeball : eyeballs)
        for (const EyeFaps& eye : eye_faps)
            if (eye.pupil == eyeball.pupil) numbers.insert(numbers.end(), {eye.yaw, eye.pitch, eye.thrust});
    return numbers;
}

// Parameters that never move their point so far that it could be seen: rounding, and skin that is not quite still.
void add_unseen_faps(const FapStream& stream, const Fapu& fapu, double scale, std::vector<int>& numbers) {
    constexpr double least = 0.005;  // of the eye distance
    for (int fap = 3; fap <= 68; ++fap) {
        if (fap_info(fap).unit == FapUnit::angle) continue;
        std::int32_t largest = 0;
        for (const FapFrame& frame : stream.frames) largest = std::max(largest, std::abs(frame.value[fap_index(fap)]));
        if (largest * unit_length(fapu, fap_info(fap).unit) < least * scale) numbers.push_back(fap);
    }
}

FaceDefTransform turn(std::uint32_t node, const Vec3& axis) {
    return {node, TransformField::rotation, axis, unit_length({}, FapUnit::angle), {}, {}};
}

using Tables = std::map<int, FaceDefTables>;

void add_transforms(Fat& fat, Tables& tables, const Ground& ground, const Fapu& fapu,
                    const std::vector<MovingEyeball>& eyeballs) {
    for (const MovingEyeball& eyeball : eyeballs) {
        const auto node = static_cast<std::uint32_t>(fat.nodes.size());
        fat.nodes.push_back({eyeball.name, eyeball.vertices, eyeball.centre});
        for (const EyeFaps& eye : eye_faps) {
            if (eye.pupil != eyeball.pupil) continue;
            tables[eye.yaw].transforms.push_back(turn(node, {0, 1, 0}));
            tables[eye.pitch].transforms.push_back(turn(node, {1, 0, 0}));
            tables[eye.thrust].transforms.push_back(
                {node, TransformField::translation, {0, 0, 1}, 0, {0, 0, unit_length(fapu, FapUnit::es)}, {}});
        }
    }
    FatNode head{"head", {}, fapu.neck};
    for (std::uint32_t v = 0; v < vertex_count(ground.face.mesh); ++v) head.vertices.push_back(v);
    const auto node = static_cast<std::uint32_t>(fat.nodes.size());
    fat.nodes.push_back(std::move(head));
    constexpr std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    for (std::size_t i = 0; i < axes.size(); ++i) tables[head_faps[i]].transforms.push_back(turn(node, axes[i]));
}

// Pieces that hang on the jaw follow it as a whole where that is as near to the truth as shares of each vertex are;
// they have no shares then.
void add_parts(const UprightSequence& upright, const Ground& ground, const FapColumns& columns, const Model& model,
               const Eigen::VectorXd& motion, const std::vector<MovingEyeball>& eyeballs, Eigen::MatrixXd& shares,
               Fat& fat, Tables& tables) {
    constexpr double as_near = 1.05, exact = 1e-3;  // of the shares' error; of the eye distance
    std::vector<bool> taken(vertex_count(ground.face.mesh), false);
    for (const MovingEyeball& eyeball : eyeballs)
        for (const std::uint32_t v : eyeball.vertices) taken[v] = true;
    const Eigen::VectorXd left = left_by(model, shares, motion);
    for (const RigidPart& part : rigid_parts(upright, ground.weld, columns.rows, taken)) {
        const PartFit fit = fit_part(part, ground.face.mesh, columns);
        std::vector<Index> places;
        for (std::size_t p = 0; p < ground.places.size(); ++p)
            if (std::binary_search(part.vertices.begin(), part.vertices.end(), ground.vertices[p]))
                places.push_back(static_cast<Index>(p));
        double squares = 0;
        for (const Index p : places) squares += left[p] / static_cast<double>(places.size());
        if (fit.error > std::max(as_near * std::sqrt(squares), exact * ground.scale)) continue;
        for (const Index p : places) shares.middleCols(3 * p, 3).setZero();
        const auto node = static_cast<std::uint32_t>(fat.nodes.size());
        fat.nodes.push_back({part.name, part.vertices, fit.centre});
        for (const PartTransform& follows : fit.transforms) {
            tables[follows.fap].transforms.push_back(follows.transform);
            tables[follows.fap].transforms.back().node = node;
        }
    }
}

// How the parameters show in the frames.
std::vector<LearntParameter> seen_parameters(const FapColumns& columns) {
    constexpr double near_rest = 0.05;  // of the largest value
    const Eigen::MatrixXd& x = columns.values;
    std::vector<LearntParameter> parameters(columns.faps.size());
    for (Index r = 0; r < x.rows(); ++r) {
        std::vector<std::size_t> active;
        for (Index k = 0; k < x.cols(); ++k)
            if (std::abs(x(r, k)) > near_rest * x.col(k).cwiseAbs().maxCoeff())
                active.push_back(static_cast<std::size_t>(k));
        for (const std::size_t k : active) ++parameters[k].active;
        if (active.size() == 1) ++parameters[active.front()].alone;
    }
    const Eigen::VectorXd scale = x.colwise().norm().cwiseInverse().transpose();
    Eigen::MatrixXd gram = scale.asDiagonal() * (x.transpose() * x) * scale.asDiagonal();
    gram.diagonal().array() += 1e-9;
    const Eigen::MatrixXd inverse = gram.ldlt().solve(Eigen::MatrixXd::Identity(gram.rows(), gram.cols()));
    for (std::size_t k = 0; k < parameters.size(); ++k) {
        const double own = inverse(static_cast<Index>(k), static_cast<Index>(k));
        parameters[k].fap = columns.faps[k];
        parameters[k].confidence = std::clamp(1 / own, 0.0, 1.0);
    }
    return parameters;
}

std::vector<double> per_vertex(const Ground& ground, const Eigen::VectorXd& squares) {
    std::vector<double> of_place(ground.weld.vertex.size(), 0), result;
    for (std::size_t p = 0; p < ground.places.size(); ++p)
        of_place[ground.places[p]] = std::sqrt(squares.segment(static_cast<Index>(3 * p), 3).sum());
    for (const std::uint32_t place : ground.weld.place) result.push_back(of_place[place]);
    return result;
}

}  // namespace

namespace {

// What is known whichever way the tables were made.
LearntFat told(const FapColumns& columns, const Ground& ground, const Model& model, const Eigen::VectorXd& motion,
               Tables tables) {
    LearntFat learnt;
    learnt.parameters = seen_parameters(columns);
    learnt.motion = per_vertex(ground, motion);
    learnt.beyond = per_vertex(ground, beyond_of(model, motion));
    for (LearntParameter& parameter : learnt.parameters)
        for (const FaceDefMesh& mesh : tables[parameter.fap].meshes) {
            parameter.vertices += mesh.vertices.size();
            parameter.intervals = std::max(parameter.intervals, mesh.borders.size() - 1);
        }
    for (auto& [fap, table] : tables) {
        table.fap = fap;
        if (!table.meshes.empty() || !table.transforms.empty()) learnt.fat.tables.push_back(std::move(table));
    }
    return learnt;
}

}  // namespace

LearntFat learn_fat(const UprightSequence& upright, const Fapu& fapu, const FapStream& stream, Reading reading) {
    const bool as_written = reading == Reading::paper;
    const std::vector<MovingEyeball> eyeballs = as_written ? std::vector<MovingEyeball>() : moving_eyeballs(upright);
    std::vector<int> left_out = transform_faps(eyeballs);
    if (!as_written) add_unseen_faps(stream, fapu, face_scale({upright.sequence.mesh, upright.points}), left_out);
    const FapColumns columns = fap_columns(upright.sequence, stream, left_out);
    const Ground ground = prepare(upright, columns, eyeballs);
    Eigen::VectorXd motion;
    const Model model = fit_model(upright.sequence, columns, ground.vertices, motion);
    Fat nodes;
    Tables tables;
    if (as_written) {
        for (FaceDefTables& table : learn_tables_written(upright, stream)) tables[table.fap] = std::move(table);
    } else {
        Eigen::MatrixXd found = shares(model, expect(ground, fapu, columns, model));
        add_parts(upright, ground, columns, model, motion, eyeballs, found, nodes, tables);
        for (std::size_t k = 0; k < columns.faps.size(); ++k) {
            FaceDefMesh mesh = mesh_of(ground, fapu, columns.faps[k], model, found, course_of(columns, model, k));
            if (!mesh.vertices.empty()) tables[columns.faps[k]].meshes.push_back(std::move(mesh));
        }
    }
    add_transforms(nodes, tables, ground, fapu, eyeballs);
    LearntFat learnt = told(columns, ground, model, motion, std::move(tables));
    learnt.fat.nodes = std::move(nodes.nodes);
    return learnt;
}

}  // namespace mien
