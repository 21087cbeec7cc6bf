// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Example shapes as a face animation table. Each shape shows parameters, those of its feature points (Laftsidis et al.,
// eq. 1); what the base table leaves of the shape, played by them, is shared among them by ridge least squares: of all
// changes to the table that give the shapes back the smallest. Above and below zero a parameter is two, since a lid
// that closes and one that opens wide are different shapes.

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "mien/algorithms/bake_fat.hpp"
#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/expressions.hpp"
#include "mien/algorithms/faps.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

// A parameter on one side of zero.
struct Half {
    int fap = 0;
    bool above = true;
    friend constexpr bool operator<(const Half& a, const Half& b) {
        return std::pair(a.fap, a.above) < std::pair(b.fap, b.above);
    }
};

// Those that a shape shows by its points; eyeballs and the head turn by themselves.
bool is_shown(int fap) {
    const Fap& info = fap_info(fap);
    const bool eye = info.point == "3.5" || info.point == "3.6";
    return fap >= 3 && !eye && info.point != "7.1";
}

struct HighLevel {
    int fap = 0, select = 0;
};

std::optional<HighLevel> high_level(std::string_view name) {
    constexpr std::string_view viseme = "viseme_";
    for (std::size_t i = 1; i < viseme_names.size(); ++i)
        if (name.starts_with(viseme) && name.substr(viseme.size()) == viseme_names[i].name)
            return HighLevel{1, static_cast<int>(i)};
    constexpr std::array<std::pair<std::string_view, int>, 4> emotions{
        {{"happy", 1}, {"sad", 2}, {"angry", 3}, {"surprised", 6}}};
    for (const auto& [emotion, select] : emotions)
        if (name == emotion) return HighLevel{2, select};
    return std::nullopt;
}

bool is_arkit(std::string_view name) {
    const auto all = named_shapes();
    return std::any_of(all.begin(), all.end(),
                       [&](const NamedShape& s) { return s.name == name && s.set == ShapeSet::arkit; });
}

void check(const MorphTarget& shape, std::size_t vertices) {
    const bool fits =
        shape.vertices.size() == shape.deltas.size() &&
        std::all_of(shape.vertices.begin(), shape.vertices.end(), [&](std::uint32_t v) { return v < vertices; });
    if (!fits)
        throw Error(fmt::format("table of shapes, {}: expected vertices below {} with a delta each, found others",
                                shape.name, vertices));
}

class Bender {
public:
    Bender(const Fat& base, const Mesh& mesh, const Fapu& fapu, std::span<const FeaturePoint> points)
        : mesh_(mesh), fapu_(fapu), points_(points), turns_(vertex_count(mesh)) {
        result_.fat = base;
        for (const FatNode& node : base.nodes)
            if (node.vertices.size() < vertex_count(mesh))
                for (const std::uint32_t v : node.vertices) turns_[v] = true;
    }

    void add(const MorphTarget& shape) {
        const std::optional<std::string_view> name = standard_shape(shape.name);
        if (!name) return;
        check(shape, vertex_count(mesh_));
        if (const auto select = high_level(*name))
            add_high_level(*select, shape);
        else if (is_arkit(*name))
            shapes_.push_back(&shape);
    }

    BakedFat bend(double ridge) {
        if (shapes_.empty() && added_.empty())
            throw Error("table of shapes: expected shapes by the names of ARKit, visemes or VRM, found none");
        show();
        if (!halves_.empty()) share(ridge);
        std::sort(result_.fat.tables.begin(), result_.fat.tables.end(),
                  [](const FaceDefTables& a, const FaceDefTables& b) {
                      return std::pair(a.fap, a.high_level_select) < std::pair(b.fap, b.high_level_select);
                  });
        measure();
        return std::move(result_);
    }

private:
    // At full strength with the greatest value, 63.
    void add_high_level(const HighLevel& select, const MorphTarget& shape) {
        constexpr int full = 63;
        if (std::any_of(added_.begin(), added_.end(),
                        [&](const HighLevel& h) { return h.fap == select.fap && h.select == select.select; }))
            return;
        FaceDefMesh mesh{{0, full}, {}, {}};
        for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
            if (turns_[shape.vertices[i]]) continue;
            mesh.vertices.push_back(shape.vertices[i]);
            mesh.displacements.push_back(shape.deltas[i] / static_cast<float>(full));
        }
        std::erase_if(result_.fat.tables, [&](const FaceDefTables& t) {
            return t.fap == select.fap && t.high_level_select == select.select;
        });
        result_.fat.tables.push_back({select.fap, select.select, {std::move(mesh)}, {}});
        added_.push_back(select);
    }

    // The parameters of each shape, and the halves that any of them shows.
    void show() {
        Take take;
        for (const FeaturePoint& point : points_) take.points.push_back(point.id);
        for (const MorphTarget* shape : shapes_) {
            take.times.push_back(static_cast<double>(take.times.size()));
            for (const FeaturePoint& point : points_)
                take.samples.push_back(point.position + delta_at(*shape, point.vertex));
        }
        if (take.times.empty()) return;
        ToFapsOptions options;
        options.rate = 1;
        const FapStream stream = to_faps(take, fapu_, options);
        for (FapFrame frame : stream.frames) {
            for (int fap = 1; fap <= static_cast<int>(fap_count); ++fap) {
                std::int32_t& value = frame.value[fap_index(fap)];
                if (!is_shown(fap)) value = 0;
                if (value != 0) halves_.emplace(Half{fap, value > 0}, halves_.size());
            }
            frames_.push_back(frame);
        }
    }

    static Vec3 delta_at(const MorphTarget& shape, std::uint32_t vertex) {
        const auto found = std::lower_bound(shape.vertices.begin(), shape.vertices.end(), vertex);
        if (found == shape.vertices.end() || *found != vertex) return {};
        return to_double(shape.deltas[static_cast<std::size_t>(found - shape.vertices.begin())]);
    }

    // Values as ways, so that one parameter costs as much as another.
    [[nodiscard]] double way(const Half& half, std::int32_t value) const {
        const double size =
            fap_info(half.fap).unit == FapUnit::angle ? 1e-5 : unit_length(fapu_, fap_info(half.fap).unit) / fapu_.es;
        return (value > 0) == half.above ? value * size : 0;
    }

    void share(double ridge) {
        const auto shapes = static_cast<Eigen::Index>(frames_.size()),
                   halves = static_cast<Eigen::Index>(halves_.size());
        Eigen::MatrixXd shown = Eigen::MatrixXd::Zero(shapes, halves);
        for (Eigen::Index k = 0; k < shapes; ++k)
            for (const auto& [half, column] : halves_)
                shown(k, static_cast<Eigen::Index>(column)) =
                    way(half, frames_[static_cast<std::size_t>(k)].value[fap_index(half.fap)]);
        Eigen::MatrixXd gram = shown * shown.transpose();
        gram.diagonal().array() += ridge * gram.trace() / static_cast<double>(shapes);
        const Eigen::MatrixXd shares = shown.transpose() * gram.ldlt().solve(Eigen::MatrixXd::Identity(shapes, shapes));
        const std::vector<std::vector<Vec3f>> left = left_over();
        for (const auto& [half, column] : halves_) {
            std::vector<Vec3f> change(vertex_count(mesh_));
            for (std::size_t k = 0; k < left.size(); ++k) {
                const auto share =
                    static_cast<float>(shares(static_cast<Eigen::Index>(column), static_cast<Eigen::Index>(k)));
                if (share == 0) continue;
                for (std::size_t v = 0; v < change.size(); ++v) change[v] += share * left[k][v];
            }
            bend_table(half, change);
        }
    }

    // What the base does not do of each shape.
    [[nodiscard]] std::vector<std::vector<Vec3f>> left_over() const {
        std::vector<std::vector<Vec3f>> left;
        std::vector<Vec3f> positions(vertex_count(mesh_));
        for (std::size_t k = 0; k < shapes_.size(); ++k) {
            deform(result_.fat, mesh_.positions, frames_[k], positions);
            std::vector<Vec3f>& row = left.emplace_back(positions.size());
            for (std::size_t v = 0; v < row.size(); ++v) row[v] = mesh_.positions[v] - positions[v];
            for (std::size_t i = 0; i < shapes_[k]->vertices.size(); ++i)
                row[shapes_[k]->vertices[i]] += shapes_[k]->deltas[i];
            for (std::size_t v = 0; v < row.size(); ++v)
                if (turns_[v]) row[v] = {};
        }
        return left;
    }

    FaceDefTables& table_of(int fap) {
        const auto found = std::find_if(result_.fat.tables.begin(), result_.fat.tables.end(),
                                        [&](const FaceDefTables& t) { return t.fap == fap; });
        if (found != result_.fat.tables.end()) return *found;
        return result_.fat.tables.emplace_back(FaceDefTables{fap, 0, {}, {}});
    }

    // Adds the change, which is per way, to all intervals of one side.
    void bend_table(const Half& half, const std::vector<Vec3f>& change) {
        FaceDefTables& table = table_of(half.fap);
        if (table.meshes.empty()) table.meshes.push_back({{-1024, 0, 1024}, {}, {}});
        FaceDefMesh& mesh = table.meshes.front();
        const std::size_t intervals = mesh.borders.size() - 1;
        const auto per_value = static_cast<float>(std::abs(way(half, half.above ? 1 : -1)));
        FaceDefMesh bent{mesh.borders, {}, {}};
        std::size_t old = 0;
        constexpr float least = 1e-4F;
        float most = 0;
        for (const Vec3f& c : change) most = std::max(most, length(c));
        for (std::uint32_t v = 0; v < change.size(); ++v) {
            const bool is_old = old < mesh.vertices.size() && mesh.vertices[old] == v;
            const bool is_changed = length(change[v]) > least * most;
            if (is_old || is_changed) bent.vertices.push_back(v);
            for (std::size_t j = 0; (is_old || is_changed) && j < intervals; ++j) {
                const Vec3f before = is_old ? mesh.displacements[old * intervals + j] : Vec3f{};
                const bool here = (mesh.borders[j + 1] > 0) == half.above;
                bent.displacements.push_back(here && is_changed ? before + per_value * change[v] : before);
            }
            if (is_old) ++old;
        }
        mesh = std::move(bent);
    }

    void measure() {
        double sum = 0;
        std::vector<Vec3f> positions(vertex_count(mesh_)), expected;
        for (std::size_t k = 0; k < shapes_.size(); ++k) {
            deform(result_.fat, mesh_.positions, frames_[k], positions);
            expected = mesh_.positions;
            for (std::size_t i = 0; i < shapes_[k]->vertices.size(); ++i)
                expected[shapes_[k]->vertices[i]] += shapes_[k]->deltas[i];
            for (std::size_t v = 0; v < expected.size(); ++v) {
                if (turns_[v]) continue;
                const double off = distance(positions[v], expected[v]);
                sum += off * off;
                result_.alone.max = std::max(result_.alone.max, off);
            }
        }
        const double count = static_cast<double>(shapes_.size()) * static_cast<double>(positions.size());
        if (count > 0) result_.alone.mean = std::sqrt(sum / count);
    }

    const Mesh& mesh_;
    const Fapu& fapu_;
    std::span<const FeaturePoint> points_;
    std::vector<bool> turns_;  // per vertex: of an eyeball
    std::vector<const MorphTarget*> shapes_;
    std::vector<FapFrame> frames_;  // one per shape
    std::map<Half, std::size_t> halves_;
    std::vector<HighLevel> added_;
    BakedFat result_;
};

}  // namespace

BakedFat fat_of_shapes(const Fat& base, const Mesh& mesh, const Fapu& fapu, std::span<const FeaturePoint> points,
                       std::span<const MorphTarget> shapes, const FatOfShapesOptions& options) {
    check_fat(base, vertex_count(mesh));
    Bender bender(base, mesh, fapu, points);
    for (const MorphTarget& shape : shapes) bender.add(shape);
    return bender.bend(options.ridge);
}

}  // namespace mien
