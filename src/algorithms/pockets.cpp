// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Skin that nobody sees: a depth buffer per direction, directions in all signs and orders of the coordinates so that no
// side of a face is preferred. A place sees along its normal's side only, so that the open neck of a head does not show
// the back of its mouth.

#include "algorithms/pockets.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <string_view>
#include <tbb/parallel_for.h>
#include <utility>

#include "algorithms/island.hpp"

#include "mien/algorithms/surface_distance.hpp"

namespace mien {

namespace {

constexpr int pixels = 256;           // along the longer side of a picture
constexpr double bias = 2;            // in pixels: what lies this far behind the nearest surface is seen
constexpr double least_depth = 0.15;  // in eye distances, as all below
constexpr double behind = 0.25;
constexpr double kept_round_points = 0.05;

std::vector<Vec3> directions() {
    std::vector<Vec3> list;
    for (int x = -2; x <= 2; ++x)
        for (int y = -2; y <= 2; ++y)
            for (int z = -2; z <= 2; ++z) {
                const int twos = (std::abs(x) == 2) + (std::abs(y) == 2) + (std::abs(z) == 2);
                const Vec3 d{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
                if (twos == 0 ? d == Vec3{} : twos != 1 || (x % 2 == 0 && y % 2 == 0 && z % 2 == 0)) continue;
                list.push_back(d / length(d));
            }
    return list;
}

struct SeenSkin {
    std::vector<Vec3> positions;                          // one per place
    std::vector<Vec3> normals;                            // of solved places, of any length, outwards
    std::vector<std::array<std::uint32_t, 3>> triangles;  // the skin and what fills it
};

// What fills a pocket hides its walls: an eyeball. Told by its form, as few points may not tell an eye: an island
// without points, about as deep as it is wide and high, and small beside the skin. Cards of hair are flat.
std::vector<bool> fillings(const Face& face, const Weld& weld, const std::vector<bool>& solved) {
    std::vector<bool> marked(weld.vertex.size(), false);
    const double head = diagonal(bounding_box(face.mesh));
    for (const Island& island : list_islands(face, weld)) {
        const Vec3 size = island.box.high - island.box.low;
        const auto [least, most] = std::minmax({size.x, size.y, size.z});
        if (solved[island.places.front()] || least < 0.5 * most || most > 0.2 * head) continue;
        for (const std::uint32_t p : island.places) marked[p] = true;
    }
    return marked;
}

SeenSkin skin_of(const Face& face, const Weld& weld, const std::vector<bool>& solved) {
    SeenSkin skin;
    for (std::uint32_t p = 0; p < weld.vertex.size(); ++p) skin.positions.push_back(position(face.mesh, weld, p));
    skin.normals = outward_normals(face.mesh, weld, solved);
    const std::vector<bool> filling = fillings(face, weld, solved);
    for (std::size_t f = 0; f < face_count(face.mesh); ++f) {
        const auto corners = mien::face(face.mesh, f);
        for (std::size_t i = 2; i < corners.size(); ++i) {
            const std::array t{weld.place[corners[0]], weld.place[corners[i - 1]], weld.place[corners[i]]};
            if (solved[t[0]] || filling[t[0]]) skin.triangles.push_back(t);
        }
    }
    return skin;
}

// A picture of the skin along one direction: the greatest height over each pixel.
class DepthBuffer {
public:
    DepthBuffer(const SeenSkin& skin, const Vec3& towards) {
        const Vec3 up = std::abs(towards.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
        const Vec3 across = cross(up, towards) / length(cross(up, towards));
        const Vec3 upwards = cross(towards, across);
        Vec3 low{infinity, infinity, 0}, high{-infinity, -infinity, 0};
        for (const Vec3& p : skin.positions) {
            const Vec3 at{dot(p, across), dot(p, upwards), dot(p, towards)};
            low = {std::min(low.x, at.x), std::min(low.y, at.y), 0};
            high = {std::max(high.x, at.x), std::max(high.y, at.y), 0};
            places_.push_back(at);
        }
        const double pixel = std::max(high.x - low.x, high.y - low.y) / (pixels - 2);
        const Vec3 corner = 0.5 * (low + high) - Vec3{0.5 * pixels * pixel, 0.5 * pixels * pixel, 0};
        for (Vec3& at : places_) at = (at - corner) / pixel;
        heights_.assign(static_cast<std::size_t>(pixels) * pixels, -infinity);
        for (const auto& t : skin.triangles) draw(places_[t[0]], places_[t[1]], places_[t[2]]);
    }

    [[nodiscard]] bool shows(std::size_t place) const {
        const Vec3& at = places_[place];
        return at.z + bias >= heights_[index(pixel(at.x), pixel(at.y))];
    }

private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static int pixel(double x) { return std::clamp(static_cast<int>(std::floor(x)), 0, pixels - 1); }
    static std::size_t index(int x, int y) {
        return static_cast<std::size_t>(y) * pixels + static_cast<std::size_t>(x);
    }

    void draw(const Vec3& a, const Vec3& b, const Vec3& c) {
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (!(std::abs(area) > 1e-12)) return;
        const int left = pixel(std::min({a.x, b.x, c.x})), right = pixel(std::max({a.x, b.x, c.x}));
        const int bottom = pixel(std::min({a.y, b.y, c.y})), top = pixel(std::max({a.y, b.y, c.y}));
        for (int y = bottom; y <= top; ++y)
            for (int x = left; x <= right; ++x) {
                const double px = x + 0.5 - a.x, py = y + 0.5 - a.y;
                const double v = (px * (c.y - a.y) - py * (c.x - a.x)) / area;
                const double w = ((b.x - a.x) * py - (b.y - a.y) * px) / area;
                if (v < 0 || w < 0 || v + w > 1) continue;
                double& height = heights_[index(x, y)];
                height = std::max(height, a.z + v * (b.z - a.z) + w * (c.z - a.z));
            }
    }

    std::vector<Vec3> places_;     // in pixels, z too
    std::vector<double> heights_;  // over the pixels
};

std::vector<bool> hidden_places(const SeenSkin& skin, const std::vector<bool>& solved) {
    const std::vector<Vec3> list = directions();
    std::vector<std::atomic<bool>> is_seen(skin.positions.size());
    tbb::parallel_for(std::size_t{0}, list.size(), [&](std::size_t i) {
        const DepthBuffer buffer(skin, list[i]);
        for (std::size_t p = 0; p < is_seen.size(); ++p)
            if (solved[p] && !is_seen[p] && dot(skin.normals[p], list[i]) > 0 && buffer.shows(p)) is_seen[p] = true;
    });
    std::vector<bool> hidden(solved);
    for (std::size_t p = 0; p < is_seen.size(); ++p)
        if (is_seen[p]) hidden[p] = false;
    return hidden;
}

std::vector<bool> open_borders(const Mesh& mesh, const Weld& weld) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> faces_at;
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        const auto corners = mien::face(mesh, f);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const std::uint32_t a = weld.place[corners[i]], b = weld.place[corners[(i + 1) % corners.size()]];
            ++faces_at[std::minmax(a, b)];
        }
    }
    std::vector<bool> open(weld.vertex.size(), false);
    for (const auto& [edge, count] : faces_at)
        if (count == 1 && edge.first != edge.second) open[edge.first] = open[edge.second] = true;
    return open;
}

struct Piece {
    std::vector<std::uint32_t> places, rim;
};

std::vector<Piece> pieces_of(const EdgeGraph& graph, const std::vector<bool>& marked) {
    std::vector<Piece> list;
    std::vector<bool> done(marked.size(), false);
    for (std::uint32_t first = 0; first < marked.size(); ++first) {
        if (!marked[first] || done[first]) continue;
        Piece piece{{first}, {}};
        done[first] = true;
        for (std::size_t i = 0; i < piece.places.size(); ++i)
            for (std::uint32_t e = graph.starts[piece.places[i]]; e < graph.starts[piece.places[i] + 1]; ++e) {
                const std::uint32_t next = graph.neighbours[e];
                if (!marked[next]) piece.rim.push_back(next);
                if (!marked[next] || done[next]) continue;
                done[next] = true;
                piece.places.push_back(next);
            }
        list.push_back(std::move(piece));
    }
    return list;
}

bool is_of_lid_or_lip(std::string_view id) {
    constexpr std::array ids{"2.2", "2.3", "2.4", "2.5", "2.6", "2.7", "2.8", "2.9"};
    return id.starts_with("3.") || id.starts_with("8.") || std::find(ids.begin(), ids.end(), id) != ids.end();
}

double nearest(const std::vector<Vec3>& positions, std::span<const std::uint32_t> places, const Vec3& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t place : places) least = std::min(least, distance(positions[place], p));
    return least;
}

bool is_pocket(const Piece& piece, const Face& face, const std::vector<Vec3>& positions, const std::vector<bool>& open,
               double scale) {
    if (piece.rim.empty() ||
        std::any_of(piece.places.begin(), piece.places.end(), [&](std::uint32_t p) { return open[p]; }))
        return false;
    if (std::none_of(piece.places.begin(), piece.places.end(), [&](std::uint32_t p) {
            return nearest(positions, piece.rim, positions[p]) > least_depth * scale;
        }))
        return false;
    return std::any_of(face.points.begin(), face.points.end(), [&](const FeaturePoint& point) {
        return is_of_lid_or_lip(point.id) &&
               nearest(positions, piece.rim, to_double(face.mesh.positions[point.vertex])) < behind * scale;
    });
}

// What is seen within a pocket, by a chink between lips, and cut off from every point is of the pocket.
void take_in_specks(std::vector<bool>& pocket, const Face& face, const Weld& weld, const std::vector<bool>& solved,
                    const EdgeGraph& graph) {
    std::vector<bool> open = solved;
    for (std::size_t p = 0; p < open.size(); ++p)
        if (pocket[p]) open[p] = false;
    std::vector<bool> held(open.size(), false);
    for (const FeaturePoint& point : face.points) held[weld.place[point.vertex]] = true;
    for (const Piece& piece : pieces_of(graph, open))
        if (std::any_of(piece.rim.begin(), piece.rim.end(), [&](std::uint32_t p) { return pocket[p]; }) &&
            std::none_of(piece.places.begin(), piece.places.end(), [&](std::uint32_t p) { return held[p]; }))
            for (const std::uint32_t p : piece.places) pocket[p] = true;
}

Vec3 middle_of(const Mesh& mesh, const Weld& weld) {
    Vec3 middle;
    for (std::uint32_t p = 0; p < weld.vertex.size(); ++p)
        middle += position(mesh, weld, p) / static_cast<double>(weld.vertex.size());
    return middle;
}

}  // namespace

// Outwards is where the enclosed volume is positive.
std::vector<Vec3> outward_normals(const Mesh& mesh, const Weld& weld, const std::vector<bool>& solved) {
    std::vector<Vec3> normals(weld.vertex.size());
    const Vec3 middle = middle_of(mesh, weld);
    double volume = 0;
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        const auto corners = face(mesh, f);
        for (std::size_t i = 2; i < corners.size(); ++i) {
            const std::array t{weld.place[corners[0]], weld.place[corners[i - 1]], weld.place[corners[i]]};
            if (!solved[t[0]]) continue;
            const Vec3 a = position(mesh, weld, t[0]) - middle;
            const Vec3 b = position(mesh, weld, t[1]) - middle;
            const Vec3 c = position(mesh, weld, t[2]) - middle;
            volume += dot(a, cross(b, c));
            for (const std::uint32_t p : t) normals[p] += cross(b - a, c - a);
        }
    }
    if (volume < 0)
        for (Vec3& n : normals) n = -n;
    return normals;
}

std::vector<bool> closed_pockets(const Face& face, const Weld& weld, const std::vector<bool>& solved) {
    std::vector<bool> pocket(solved.size(), false);
    if (std::none_of(face.points.begin(), face.points.end(),
                     [](const FeaturePoint& point) { return is_of_lid_or_lip(point.id); }))
        return pocket;
    const SeenSkin skin = skin_of(face, weld, solved);
    const EdgeGraph graph = edge_graph(face.mesh, weld);
    const double scale = face_scale(face);
    const std::vector<bool> open = open_borders(face.mesh, weld);
    for (const Piece& piece : pieces_of(graph, hidden_places(skin, solved)))
        if (is_pocket(piece, face, skin.positions, open, scale))
            for (const std::uint32_t p : piece.places) pocket[p] = true;
    for (const FeaturePoint& point : face.points) {
        const std::vector<double> d = surface_distances(graph, weld.place[point.vertex], kept_round_points * scale);
        for (std::size_t p = 0; p < d.size(); ++p)
            if (std::isfinite(d[p])) pocket[p] = false;
    }
    take_in_specks(pocket, face, weld, solved, graph);
    return pocket;
}

Mesh without_places(const Mesh& mesh, const Weld& weld, const std::vector<bool>& marked) {
    Mesh rest;
    rest.positions = mesh.positions;
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        const auto corners = face(mesh, f);
        if (std::none_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return marked[weld.place[v]]; }))
            add_face(rest, corners);
    }
    return rest;
}

}  // namespace mien
