// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The papers deform one connected surface. Real heads come in pieces, and surface distance never reaches the others:
//
// - eyeballs turn about their centre (eyeballs.cpp), as MPEG-4's FAPs 23-26 have it;
// - what lies in the mouth is upper teeth, which the skull holds, or lower teeth and tongue, which follow the chin;
// - what is small and near the skin (lashes, brows), or sewn to it, follows the skin at its roots; the rest of such an
//   island is the harmonic extension of its roots, so that a tip follows its own root even where the other lid is
//   nearer in space, and nothing tears;
// - all else (hair, glasses, clothes) keeps still with the skull.
//
// Names of parts go before places where they are plain, because files differ too much in how their parts lie.

#include "mien/algorithms/attach.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>

#include "algorithms/eyeballs.hpp"
#include "algorithms/island.hpp"
#include "algorithms/surface_tree.hpp"
#include "algorithms/weight_rows.hpp"

#include "mien/algorithms/surface_distance.hpp"

namespace mien {

std::vector<bool> solved_places(const Face& face, const Weld& weld) {
    const std::vector<Island> list = list_islands(face, weld);
    std::vector<bool> is_solved(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) is_solved[i] = !list[i].points.empty();
    for (const EyeballIslands& eyeball : find_eyeballs(face, weld, list))
        for (const std::uint32_t i : eyeball.islands) is_solved[i] = false;

    std::vector<bool> solved(weld.vertex.size(), false);
    for (std::size_t i = 0; i < list.size(); ++i)
        for (const std::uint32_t p : list[i].places) solved[p] = is_solved[i];
    return solved;
}

namespace {

using Row = std::vector<PointWeight>;

enum class Carrier { skull, jaw, skin };

constexpr std::array carrier_words{"follows the skull", "follows the jaw", "follows the skin"};

struct Head {
    const Face& face;
    const Weld& weld;
    double scale;
    SurfaceTree skin;
};

std::string lower_case(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

bool names_any(const std::string& name, std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(), [&](const char* word) { return name.find(word) != name.npos; });
}

Vec3 middle_of(const Island& island) {
    return 0.5 * (island.box.low + island.box.high);
}

// The middle of the lips, inner ones first.
std::optional<Vec3> mouth(std::span<const FeaturePoint> points) {
    for (const auto& [upper, lower] : {std::pair{"2.2", "2.3"}, {"8.1", "8.2"}, {"2.4", "2.5"}, {"8.3", "8.4"}}) {
        const auto a = find_point(points, upper);
        const auto b = find_point(points, lower);
        if (a && b) return 0.5 * (points[*a].position + points[*b].position);
    }
    return std::nullopt;
}

bool lies_in_mouth(const Head& head, const Island& island) {
    const auto lips = mouth(head.face.points);
    if (!lips) return false;
    const Vec3 from_lips = (middle_of(island) - *lips) / head.scale;
    return std::abs(from_lips.x) < 0.5 && std::abs(from_lips.y) < 0.5 && from_lips.z < 0 && from_lips.z > -1.5 &&
           diagonal(island.box) < 2.5 * head.scale;
}

// Upper teeth lie clearly above the line between the lips; the tongue lies on it.
Carrier upper_or_lower(const Head& head, const Island& island, const std::string& name) {
    if (names_any(name, {"upper", "top", "maxil"})) return Carrier::skull;
    if (names_any(name, {"lower", "bottom", "mandib"})) return Carrier::jaw;
    const auto lips = mouth(head.face.points);
    return lips && middle_of(island).y < lips->y + 0.05 * head.scale ? Carrier::jaw : Carrier::skull;
}

std::vector<SurfacePoint> nearest_skin(const Head& head, const Island& island) {
    std::vector<SurfacePoint> nearest;
    for (const std::uint32_t p : island.places)
        nearest.push_back(head.skin.nearest(position(head.face.mesh, head.weld, p)));
    return nearest;
}

// Small and near the skin all over, or lying on it with a tenth of its places.
bool is_at_skin(const Head& head, const Island& island) {
    const auto nearest = nearest_skin(head, island);
    const auto within = [&](double reach) {
        return std::count_if(nearest.begin(), nearest.end(),
                             [&](const SurfacePoint& s) { return s.distance < reach * head.scale; });
    };
    const bool is_near = diagonal(island.box) < 1.2 * head.scale && within(0.25) == std::ssize(nearest);
    return is_near || (nearest.size() >= 8 && 10 * within(0.005) >= std::ssize(nearest));
}

Carrier carrier_of(const Head& head, const Island& island) {
    const std::string name = lower_case(island.part);
    if (names_any(name, {"lash", "eyebrow", "moustache", "mustache", "beard", "tearline", "caruncle"}))
        return Carrier::skin;
    if (names_any(name, {"tongue"}) && !names_any(name, {"teeth", "tooth"})) return Carrier::jaw;
    if (names_any(name, {"teeth", "tooth", "gums"}) || lies_in_mouth(head, island))
        return upper_or_lower(head, island, name);
    return is_at_skin(head, island) ? Carrier::skin : Carrier::skull;
}

// Per axis the first of these that moves along it: the chin on the bone, under it, beside it; then the lower lip.
Row jaw_row(std::span<const FeaturePoint> points) {
    std::map<std::uint16_t, Vec3f> row;
    for (int axis = 0; axis < 3; ++axis)
        for (const char* id : {"2.10", "2.1", "2.11", "2.12", "2.3", "8.2", "2.9", "2.8"}) {
            const auto point = find_point(points, id);
            if (!point || !moves_along(points[*point], axis)) continue;
            Vec3f& weight = row[static_cast<std::uint16_t>(*point)];
            (axis == 0 ? weight.x : axis == 1 ? weight.y : weight.z) = 1;
            break;
        }
    Row entries;
    for (const auto& [point, weight] : row) entries.push_back({point, weight});
    return entries;
}

Row row_of(const Rig& rig, std::uint32_t vertex) {
    Row row;
    for (std::uint32_t e = rig.row_starts[vertex]; e < rig.row_starts[vertex + 1]; ++e)
        row.push_back({rig.row_points[e], rig.weights[e]});
    return row;
}

// Roots are the quarter of an island's reach that is nearest to the skin, and all that lies on it.
std::vector<bool> roots_of(std::span<const SurfacePoint> nearest, double scale) {
    const auto [low, high] = std::minmax_element(nearest.begin(), nearest.end(),
                                                 [](const auto& a, const auto& b) { return a.distance < b.distance; });
    const double reach = std::max(0.01 * scale, low->distance + 0.25 * (high->distance - low->distance));
    std::vector<bool> roots;
    for (const SurfacePoint& s : nearest) roots.push_back(s.distance <= reach);
    return roots;
}

// Weights of an island, one row per place and three columns (x, y, z) per rig point in `points`.
struct WeightTable {
    std::vector<std::uint16_t> points;
    Eigen::MatrixXd weights;
};

// The rows of the skin under the roots; zero elsewhere.
WeightTable root_table(const Head& head, const Rig& rig, std::span<const SurfacePoint> nearest,
                       const std::vector<bool>& roots) {
    std::map<std::uint16_t, Eigen::Index> column;
    for (std::size_t k = 0; k < nearest.size(); ++k)
        if (roots[k])
            for (const std::uint32_t p : nearest[k].places)
                for (const PointWeight& w : row_of(rig, head.weld.vertex[p])) column.emplace(w.point, 0);
    WeightTable table;
    for (auto& [point, number] : column) {
        number = 3 * std::ssize(table.points);
        table.points.push_back(point);
    }
    table.weights = Eigen::MatrixXd::Zero(std::ssize(nearest), 3 * std::ssize(table.points));
    for (std::size_t k = 0; k < nearest.size(); ++k)
        for (std::size_t corner = 0; roots[k] && corner < 3; ++corner)
            for (const PointWeight& w : row_of(rig, head.weld.vertex[nearest[k].places[corner]]))
                table.weights.row(static_cast<Eigen::Index>(k)).segment<3>(column[w.point]) +=
                    nearest[k].shares[corner] * Eigen::RowVector3d(w.weight.x, w.weight.y, w.weight.z);
    return table;
}

// Fills the rows of the places that are no roots: each is the mean of its neighbours, weighted by 1 / edge length.
void extend_harmonically(Eigen::MatrixXd& weights, const EdgeGraph& graph, std::span<const std::uint32_t> places,
                         const std::vector<bool>& roots, double scale) {
    std::vector<Eigen::Index> unknown(places.size(), -1);
    Eigen::Index unknowns = 0;
    for (std::size_t k = 0; k < places.size(); ++k)
        if (!roots[k]) unknown[k] = unknowns++;
    if (unknowns == 0) return;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(unknowns, weights.cols());
    for (std::size_t k = 0; k < places.size(); ++k) {
        if (roots[k]) continue;
        for (std::uint32_t e = graph.starts[places[k]]; e < graph.starts[places[k] + 1]; ++e) {
            const auto n = std::lower_bound(places.begin(), places.end(), graph.neighbours[e]) - places.begin();
            const double pull = scale / std::max(graph.lengths[e], 1e-6 * scale);
            entries.emplace_back(unknown[k], unknown[k], pull);
            if (roots[n]) right.row(unknown[k]) += pull * weights.row(n);
            if (!roots[n]) entries.emplace_back(unknown[k], unknown[n], -pull);
        }
    }
    Eigen::SparseMatrix<double> laplacian(unknowns, unknowns);
    laplacian.setFromTriplets(entries.begin(), entries.end());
    const Eigen::MatrixXd solved = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(laplacian).solve(right);
    for (std::size_t k = 0; k < places.size(); ++k)
        if (!roots[k]) weights.row(static_cast<Eigen::Index>(k)) = solved.row(unknown[k]);
}

// The heaviest `limit` points of a row of the table, scaled so that the row keeps its sum along each axis.
Row heaviest(const WeightTable& table, Eigen::Index k, std::size_t limit) {
    Row row;
    for (std::size_t i = 0; i < table.points.size(); ++i) {
        const Eigen::RowVector3d w = table.weights.row(k).segment<3>(static_cast<Eigen::Index>(3 * i));
        if (w.squaredNorm() > 1e-12) row.push_back({table.points[i], to_float(Vec3{w[0], w[1], w[2]})});
    }
    const auto sum = [&] {
        Vec3f total;
        for (const PointWeight& w : row) total += w.weight;
        return total;
    };
    if (row.size() <= limit) return row;
    const Vec3f before = sum();
    std::stable_sort(row.begin(), row.end(),
                     [](const auto& a, const auto& b) { return length(a.weight) > length(b.weight); });
    row.resize(limit);
    const Vec3f after = sum();
    const auto ratio = [](float a, float b) { return std::abs(b) > 0.5F * std::abs(a) && b != 0 ? a / b : 1; };
    for (PointWeight& w : row)
        w.weight = {w.weight.x * ratio(before.x, after.x), w.weight.y * ratio(before.y, after.y),
                    w.weight.z * ratio(before.z, after.z)};
    std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.point < b.point; });
    return row;
}

std::size_t longest_row(const Rig& rig) {
    std::uint32_t longest = 1;
    for (std::size_t v = 0; v < vertex_count(rig); ++v)
        longest = std::max(longest, rig.row_starts[v + 1] - rig.row_starts[v]);
    return longest;
}

void attach_to_skin(std::vector<Row>& attached, const Head& head, const Rig& rig, const EdgeGraph& graph,
                    const Island& island) {
    const std::vector<SurfacePoint> nearest = nearest_skin(head, island);
    if (!std::isfinite(nearest.front().distance)) return;
    const std::vector<bool> roots = roots_of(nearest, head.scale);
    WeightTable table = root_table(head, rig, nearest, roots);
    extend_harmonically(table.weights, graph, island.places, roots, head.scale);
    const std::size_t limit = longest_row(rig);
    for (std::size_t k = 0; k < island.places.size(); ++k)
        attached[island.places[k]] = heaviest(table, static_cast<Eigen::Index>(k), limit);
}

std::string name_of(const Island& island, std::size_t number) {
    if (!island.has_faces) return "loose vertices";
    return island.part.empty() ? fmt::format("island {}", number) : island.part;
}

// Pieces of one name that go one way are one line of the report.
void report(Rig& rig, const std::string& name, const char* how, std::uint32_t vertices) {
    const auto same = std::find_if(rig.attachments.begin(), rig.attachments.end(),
                                   [&](const Attachment& a) { return a.name == name && a.how == how; });
    if (same == rig.attachments.end())
        rig.attachments.push_back({name, how, vertices});
    else
        same->vertices += vertices;
}

// The pupil point that aims a ball: 3.5 or 3.6, whichever is on it or close before it.
std::optional<std::uint32_t> pupil_of(const Rig& rig, const Sphere& ball) {
    std::optional<std::uint32_t> best;
    double reach = 1.5 * ball.radius;
    for (const char* id : {"3.5", "3.6"}) {
        const auto point = find_point(rig.points, id);
        if (!point || !(distance(rig.points[*point].position, ball.centre) < reach)) continue;
        reach = distance(rig.points[*point].position, ball.centre);
        best = static_cast<std::uint32_t>(*point);
    }
    return best;
}

using PlaceVertices = std::vector<std::vector<std::uint32_t>>;

std::uint32_t count_vertices(const Island& island, const PlaceVertices& vertices) {
    std::size_t count = 0;
    for (const std::uint32_t p : island.places) count += vertices[p].size();
    return static_cast<std::uint32_t>(count);
}

void add_eyeball(Rig& rig, const EyeballIslands& found, std::span<const Island> list, const PlaceVertices& vertices) {
    Eyeball eyeball{
        name_of(list[found.islands.front()], found.islands.front()), {}, found.ball.centre, pupil_of(rig, found.ball)};
    for (const std::uint32_t i : found.islands) {
        for (const std::uint32_t p : list[i].places)
            eyeball.vertices.insert(eyeball.vertices.end(), vertices[p].begin(), vertices[p].end());
        report(rig, name_of(list[i], i), "turns about its centre", count_vertices(list[i], vertices));
    }
    std::sort(eyeball.vertices.begin(), eyeball.vertices.end());
    rig.eyeballs.push_back(std::move(eyeball));
}

// The rig's rows with those of the attached places in place of empty ones.
void insert_rows(Rig& rig, const Weld& weld, const std::vector<Row>& attached) {
    Rig with = rig;
    with.row_starts.assign(1, 0);
    with.row_points.clear();
    with.weights.clear();
    for (std::uint32_t v = 0; v < weld.place.size(); ++v) {
        const Row& own = attached[weld.place[v]];
        for (const PointWeight& entry : own.empty() ? row_of(rig, v) : own) {
            with.row_points.push_back(entry.point);
            with.weights.push_back(entry.weight);
        }
        with.row_starts.push_back(static_cast<std::uint32_t>(with.row_points.size()));
    }
    rig = std::move(with);
}

}  // namespace

void attach_islands(Rig& rig, const Face& face, const Weld& weld) {
    const std::vector<Island> list = list_islands(face, weld);
    const std::vector<bool> solved = solved_places(face, weld);
    PlaceVertices vertices(weld.vertex.size());
    for (std::uint32_t v = 0; v < weld.place.size(); ++v) vertices[weld.place[v]].push_back(v);
    std::vector<bool> is_done(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) is_done[i] = solved[list[i].places.front()];

    for (const EyeballIslands& eyeball : find_eyeballs(face, weld, list)) {
        add_eyeball(rig, eyeball, list, vertices);
        for (const std::uint32_t i : eyeball.islands) is_done[i] = true;
    }
    const Head head{face, weld, face_scale(face), SurfaceTree(face.mesh, weld, solved)};
    const EdgeGraph graph = edge_graph(face.mesh, weld);
    const Row jaw = jaw_row(rig.points);
    std::vector<Row> attached(weld.vertex.size());
    for (std::size_t i = 0; i < list.size(); ++i)
        if (!is_done[i]) {
            const Carrier carrier = carrier_of(head, list[i]);
            const bool has_carrier = carrier != Carrier::jaw || !jaw.empty();
            report(rig, name_of(list[i], i),
                   carrier_words[static_cast<std::size_t>(has_carrier ? carrier : Carrier::skull)],
                   count_vertices(list[i], vertices));
            if (carrier == Carrier::jaw)
                for (const std::uint32_t p : list[i].places) attached[p] = jaw;
            if (carrier == Carrier::skin) attach_to_skin(attached, head, rig, graph, list[i]);
        }
    insert_rows(rig, weld, attached);
}

}  // namespace mien
