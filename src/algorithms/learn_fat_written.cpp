// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Laftsidis et al., section 2.2, as written. Stage one: a vertex depends on a parameter if it is displaced in every
// frame in which the parameter is active, that is not 0. Stage two: of these vertices those stay that growth from the
// feature point over the edges of the mesh reaches. Then every vertex keeps, of the frames in which the parameter is
// active, those in which it went farthest along an axis, either way, and its displacement is drawn straight between
// them and its rest at 0.
//
// Where the text is silent: "displaced" is farther than rounding (1e-6 of the eye distance); of frames with one value
// the first stands; vertices that share their borders share a FaceDefMesh. Head turns are played by the player in the
// paper and have a node here, so that tables of both readings play alike.

#include "algorithms/learn_fat_written.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "algorithms/fap_columns.hpp"
#include "algorithms/island.hpp"

#include "mien/algorithms/surface_distance.hpp"
#include "mien/algorithms/weld.hpp"

namespace mien {

namespace {

constexpr double displaced_from = 1e-6;  // of the eye distance

using Index = Eigen::Index;

// The farthest that a place goes along an axis, one way, while a parameter is active.
struct Extreme {
    double reach = 0;
    std::int32_t value = 0;
    Vec3 displacement;
};
using Extremes = std::array<Extreme, 6>;  // +x, -x, +y, -y, +z, -z

void note(Extremes& extremes, bool first, std::int32_t value, const Vec3& d) {
    const std::array reaches{d.x, -d.x, d.y, -d.y, d.z, -d.z};
    for (std::size_t i = 0; i < reaches.size(); ++i)
        if (first || reaches[i] > extremes[i].reach) extremes[i] = {reaches[i], value, d};
}

class Learner {
public:
    Learner(const UprightSequence& upright, const FapStream& stream)
        : sequence_(upright.sequence),
          face_{upright.sequence.mesh, upright.points},
          weld_(weld(face_.mesh)),
          columns_(fap_columns(sequence_, stream, std::array{48, 49, 50})),
          row_(vertex_count(face_.mesh)),
          depends_(columns_.faps.size(), std::vector<std::uint8_t>(weld_.vertex.size(), 1)) {}

    void relate() {
        const double least = displaced_from * face_scale(face_);
        std::vector<std::uint8_t> displaced(weld_.vertex.size());
        for (std::size_t r = 0; r < columns_.rows.size(); ++r) {
            read(r);
            for (std::size_t p = 0; p < displaced.size(); ++p)
                displaced[p] = length(displacement(static_cast<std::uint32_t>(p))) > least ? 1 : 0;
            for (std::size_t k = 0; k < depends_.size(); ++k)
                if (value(r, k) != 0)
                    for (std::size_t p = 0; p < displaced.size(); ++p)
                        depends_[k][p] = static_cast<std::uint8_t>(depends_[k][p] & displaced[p]);
        }
    }

    // Only what growth from the parameter's point reaches stays.
    void confirm() {
        const EdgeGraph graph = edge_graph(face_.mesh, weld_);
        for (std::size_t k = 0; k < depends_.size(); ++k) {
            std::vector<std::uint8_t> confirmed(depends_[k].size(), 0);
            std::vector<std::uint32_t> front;
            if (const auto point = find_point(face_.points, fap_info(columns_.faps[k]).point)) {
                const std::uint32_t source = weld_.place[face_.points[*point].vertex];
                confirmed[source] = depends_[k][source];
                front.push_back(source);
            }
            while (!front.empty()) {
                const std::uint32_t p = front.back();
                front.pop_back();
                for (std::uint32_t e = graph.starts[p]; e < graph.starts[p + 1]; ++e) {
                    const std::uint32_t next = graph.neighbours[e];
                    if (confirmed[next] != 0 || depends_[k][next] == 0) continue;
                    confirmed[next] = 1;
                    front.push_back(next);
                }
            }
            depends_[k] = std::move(confirmed);
        }
    }

    void find_extremes() {
        for (const std::vector<std::uint8_t>& depends : depends_) {
            places_.emplace_back();
            for (std::uint32_t p = 0; p < depends.size(); ++p)
                if (depends[p] != 0) places_.back().push_back(p);
            extremes_.emplace_back(places_.back().size());
        }
        std::vector<bool> began(depends_.size(), false);
        for (std::size_t r = 0; r < columns_.rows.size(); ++r) {
            read(r);
            for (std::size_t k = 0; k < depends_.size(); ++k) {
                const std::int32_t here = value(r, k);
                if (here == 0) continue;
                for (std::size_t i = 0; i < places_[k].size(); ++i)
                    note(extremes_[k][i], !began[k], here, displacement(places_[k][i]));
                began[k] = true;
            }
        }
    }

    [[nodiscard]] FaceDefTables table(std::size_t k) const {
        FaceDefTables table{columns_.faps[k], 0, {}, {}};
        std::vector<std::vector<std::uint32_t>> vertices(weld_.vertex.size());
        for (std::uint32_t v = 0; v < weld_.place.size(); ++v) vertices[weld_.place[v]].push_back(v);
        std::map<std::vector<std::int32_t>, std::map<std::uint32_t, std::vector<Vec3f>>> by_borders;
        for (std::size_t i = 0; i < places_[k].size(); ++i) {
            std::map<std::int32_t, Vec3> stops{{0, {}}};
            for (const Extreme& extreme : extremes_[k][i]) stops.emplace(extreme.value, extreme.displacement);
            std::vector<std::int32_t> borders;
            std::vector<Vec3f> steps;
            for (auto stop = stops.begin(); stop != stops.end(); ++stop) {
                borders.push_back(stop->first);
                if (stop == stops.begin()) continue;
                const auto before = std::prev(stop);
                steps.push_back(to_float((stop->second - before->second) /
                                         static_cast<double>(std::int64_t{stop->first} - before->first)));
            }
            for (const std::uint32_t v : vertices[places_[k][i]]) by_borders[borders][v] = steps;
        }
        for (const auto& [borders, moves] : by_borders) {
            FaceDefMesh& mesh = table.meshes.emplace_back();
            mesh.borders = borders;
            for (const auto& [vertex, steps] : moves) {
                mesh.vertices.push_back(vertex);
                mesh.displacements.insert(mesh.displacements.end(), steps.begin(), steps.end());
            }
        }
        return table;
    }

    [[nodiscard]] const FapColumns& columns() const { return columns_; }

private:
    void read(std::size_t frame) { sequence_.positions(columns_.rows[frame], row_); }

    [[nodiscard]] Vec3 displacement(std::uint32_t place) const {
        const std::uint32_t v = weld_.vertex[place];
        return to_double(row_[v]) - to_double(face_.mesh.positions[v]);
    }

    [[nodiscard]] std::int32_t value(std::size_t frame, std::size_t column) const {
        return static_cast<std::int32_t>(columns_.values(static_cast<Index>(frame), static_cast<Index>(column)));
    }

    const MeshSequence& sequence_;
    Face face_;
    Weld weld_;
    FapColumns columns_;
    std::vector<Vec3f> row_;
    std::vector<std::vector<std::uint8_t>> depends_;  // by column, then by place
    std::vector<std::vector<std::uint32_t>> places_;  // by column: those that depend
    std::vector<std::vector<Extremes>> extremes_;
};

}  // namespace

std::vector<FaceDefTables> learn_tables_written(const UprightSequence& upright, const FapStream& stream) {
    Learner learner(upright, stream);
    learner.relate();
    learner.confirm();
    learner.find_extremes();
    std::vector<FaceDefTables> tables;
    for (std::size_t k = 0; k < learner.columns().faps.size(); ++k) {
        FaceDefTables table = learner.table(k);
        if (!table.meshes.empty()) tables.push_back(std::move(table));
    }
    return tables;
}

}  // namespace mien
