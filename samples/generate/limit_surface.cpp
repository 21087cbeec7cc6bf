// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Catmull and Clark 1978, "Recursively generated B-spline surfaces on arbitrary topological meshes". Borders are cubic
// B-spline curves. The control points are found by Jacobi steps on "limit position = given point" (the limit masks of
// Halstead, Kass and DeRose 1993, "Efficient, fair interpolation using Catmull-Clark surfaces", eq. 1). Stopping after
// a fixed number of steps leaves the highest frequencies of the given points unfitted, which fairs the surface.
//
// Every cage quad is refined four times into 16 by 16; a vertex at (i/n, j/m) is interpolated in that table. So every
// strip of the cage can have a number of quads of its own, not only powers of two.

#include "limit_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mien::samples {
namespace {

constexpr int levels = 4;
constexpr int cells = 1 << levels;
constexpr int fit_steps = 14;
constexpr int usual_count = 3;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge_of(std::uint32_t a, std::uint32_t b) {
    return std::minmax(a, b);
}

struct Quad {
    std::array<std::uint32_t, 4> corners{};
    std::array<std::array<int, 2>, 4> place{};  // of the corners in the root's table
    std::uint32_t root = 0;
};

struct Control {
    std::vector<Vec3> points;
    std::vector<Quad> quads;
};

// Points on the midline are those with x = 0; they are shared by the halves.
Control mirrored(const Cage& half) {
    Control control;
    control.points = half.points;
    std::vector<std::uint32_t> other(half.points.size());
    for (std::uint32_t i = 0; i < half.points.size(); ++i) {
        const Vec3 p = half.points[i];
        other[i] = p.x == 0 ? i : static_cast<std::uint32_t>(control.points.size());
        if (p.x != 0) control.points.push_back({-p.x, p.y, p.z});
    }
    for (const CageQuad& q : half.quads)
        control.quads.push_back(
            {q.corners, {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}, static_cast<std::uint32_t>(control.quads.size())});
    const std::size_t n = half.quads.size();
    for (std::size_t i = 0; i < n; ++i) {
        Quad q = control.quads[i];
        q.root = static_cast<std::uint32_t>(n + i);
        q.corners = {other[q.corners[0]], other[q.corners[3]], other[q.corners[2]], other[q.corners[1]]};
        control.quads.push_back(q);
    }
    return control;
}

struct EdgePoint {
    Vec3 faces;  // sum of the neighbouring face points
    int face_count = 0;
    std::uint32_t index = 0;
};

using EdgeMap = std::map<Edge, EdgePoint>;

EdgeMap edges_of(const Control& control, const std::vector<Vec3>& face_points) {
    EdgeMap edges;
    for (std::size_t f = 0; f < control.quads.size(); ++f)
        for (std::size_t k = 0; k < 4; ++k) {
            const auto& c = control.quads[f].corners;
            EdgePoint& e = edges[edge_of(c[k], c[(k + 1) % 4])];
            e.faces += face_points[f];
            ++e.face_count;
        }
    return edges;
}

std::vector<Vec3> face_points_of(const Control& control) {
    std::vector<Vec3> result;
    for (const Quad& q : control.quads) {
        Vec3 sum;
        for (const auto c : q.corners) sum += control.points[c];
        result.push_back(sum / 4.0);
    }
    return result;
}

// What a vertex sees: neighbours over edges, faces, and neighbours along the border if it lies there.
struct Ring {
    Vec3 neighbours, faces, border;
    int valence = 0, face_count = 0, border_count = 0;
};

std::vector<Ring> rings_of(const Control& control, const std::vector<Vec3>& face_points, const EdgeMap& edges) {
    std::vector<Ring> rings(control.points.size());
    for (std::size_t f = 0; f < control.quads.size(); ++f)
        for (const auto c : control.quads[f].corners) rings[c].faces += face_points[f], ++rings[c].face_count;
    for (const auto& [edge, e] : edges)
        for (const auto& [from, to] : {edge, Edge{edge.second, edge.first}}) {
            Ring& r = rings[from];
            r.neighbours += control.points[to];
            ++r.valence;
            if (e.face_count == 1) r.border += control.points[to], ++r.border_count;
        }
    return rings;
}

Vec3 moved_vertex(const Vec3& p, const Ring& r) {
    if (r.border_count == 2) return 0.75 * p + 0.125 * r.border;
    const double n = r.valence;
    return (r.faces / n + r.neighbours / n + (n - 2) * p) / n;
}

Vec3 edge_point(const Control& control, const Edge& edge, const EdgePoint& e) {
    const Vec3 ends = control.points[edge.first] + control.points[edge.second];
    return e.face_count == 1 ? 0.5 * ends : (ends + e.faces) / 4.0;
}

Control refined(const Control& control) {
    const std::vector<Vec3> face_points = face_points_of(control);
    EdgeMap edges = edges_of(control, face_points);
    const std::vector<Ring> rings = rings_of(control, face_points, edges);
    Control fine;
    for (std::size_t i = 0; i < control.points.size(); ++i)
        fine.points.push_back(moved_vertex(control.points[i], rings[i]));
    for (auto& [edge, e] : edges) {
        e.index = static_cast<std::uint32_t>(fine.points.size());
        fine.points.push_back(edge_point(control, edge, e));
    }
    for (std::size_t f = 0; f < control.quads.size(); ++f) {
        const Quad& q = control.quads[f];
        const auto centre = static_cast<std::uint32_t>(fine.points.size());
        fine.points.push_back(face_points[f]);
        const auto sum = [&](std::size_t a, std::size_t b) {
            return std::array{q.place[a][0] + q.place[b][0], q.place[a][1] + q.place[b][1]};
        };
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t next = (k + 1) % 4, last = (k + 3) % 4;
            fine.quads.push_back({{q.corners[k], edges.at(edge_of(q.corners[k], q.corners[next])).index, centre,
                                   edges.at(edge_of(q.corners[last], q.corners[k])).index},
                                  {sum(k, k), sum(k, next), sum(0, 2), sum(last, k)},
                                  q.root});
        }
    }
    return fine;
}

// Halstead et al., eq. 1, written with face centroids: the neighbours across a face enter through them.
Vec3 limit_position(const Vec3& p, const Ring& r) {
    if (r.border_count == 2) return (4.0 * p + r.border) / 6.0;
    const double n = r.valence;
    // sum of diagonal neighbours = 4 * face centroids - 2 * edge neighbours - n * p
    const Vec3 diagonal = 4.0 * r.faces - 2.0 * r.neighbours - n * p;
    return (n * n * p + 4.0 * r.neighbours + diagonal) / (n * (n + 5));
}

void fit(Control& control) {
    const std::vector<Vec3> target = control.points;
    for (int step = 0; step < fit_steps; ++step) {
        const std::vector<Vec3> face_points = face_points_of(control);
        const std::vector<Ring> rings = rings_of(control, face_points, edges_of(control, face_points));
        std::vector<Vec3> next = control.points;
        for (std::size_t i = 0; i < next.size(); ++i)
            next[i] += target[i] - limit_position(control.points[i], rings[i]);
        control.points = next;
    }
}

using Table = std::vector<Vec3>;  // per root quad (cells + 1)^2 points

std::size_t table_index(std::uint32_t root, int i, int j) {
    return (static_cast<std::size_t>(root) * (cells + 1) + static_cast<std::size_t>(j)) * (cells + 1) +
           static_cast<std::size_t>(i);
}

Table limit_table(const Cage& half) {
    Control control = mirrored(half);
    fit(control);
    for (int i = 0; i < levels; ++i) control = refined(control);
    Table table(half.quads.size() * (cells + 1) * (cells + 1));
    for (const Quad& q : control.quads) {
        if (q.root >= half.quads.size()) continue;
        for (std::size_t k = 0; k < 4; ++k)
            table[table_index(q.root, q.place[k][0], q.place[k][1])] = control.points[q.corners[k]];
    }
    return table;
}

// Place (i of n, j of m) in the table of a quad.
Vec3 sample(const Table& table, std::uint32_t root, int i, int n, int j, int m) {
    const double u = static_cast<double>(i * cells) / n, v = static_cast<double>(j * cells) / m;
    const int iu = std::min(static_cast<int>(u), cells - 1), iv = std::min(static_cast<int>(v), cells - 1);
    const double s = u - iu, t = v - iv;
    const auto at = [&](int a, int b) { return table[table_index(root, a, b)]; };
    return (1 - t) * ((1 - s) * at(iu, iv) + s * at(iu + 1, iv)) +
           t * ((1 - s) * at(iu, iv + 1) + s * at(iu + 1, iv + 1));
}

// The number of quads along every edge: union of opposite edges, then the counts asked for.
class EdgeCounts {
public:
    explicit EdgeCounts(const Cage& cage) {
        for (const CageQuad& q : cage.quads)
            for (std::size_t k = 0; k < 4; ++k) parent_.emplace(side(q, k), side(q, k));
        for (const CageQuad& q : cage.quads)
            for (std::size_t k = 0; k < 2; ++k) parent_[root(side(q, k))] = root(side(q, k + 2));
        for (const EdgeCount& c : cage.counts) counts_[root(edge_of(c.a, c.b))] = c.count;
    }
    int operator()(std::uint32_t a, std::uint32_t b) const {
        const auto found = counts_.find(root(edge_of(a, b)));
        return found == counts_.end() ? usual_count : found->second;
    }

private:
    static Edge side(const CageQuad& q, std::size_t k) { return edge_of(q.corners[k], q.corners[(k + 1) % 4]); }
    Edge root(Edge e) const {
        while (parent_.at(e) != e) e = parent_.at(e);
        return e;
    }
    std::map<Edge, Edge> parent_;
    std::map<Edge, int> counts_;
};

struct Sampler {
    const Cage& cage;
    const Table& table;
    MirroredSurface& out;

    std::uint32_t add(const Vec3& p) {
        out.surface.positions.push_back(p);
        return static_cast<std::uint32_t>(out.surface.positions.size() - 1);
    }

    // The vertices from a to b along a side, which the first quad that has it makes.
    std::vector<std::uint32_t> side(std::uint32_t a, std::uint32_t b, const std::vector<Vec3>& points) {
        auto& vertices = out.edges[edge_of(a, b)];
        if (vertices.empty()) {
            vertices.push_back(a);
            for (std::size_t i = 1; i + 1 < points.size(); ++i) vertices.push_back(add(points[i]));
            vertices.push_back(b);
            if (a > b) std::reverse(vertices.begin(), vertices.end());
        }
        auto result = vertices;
        if (a > b) std::reverse(result.begin(), result.end());
        return result;
    }

    void add_quad(std::uint32_t root, int n, int m) {
        const CageQuad& q = cage.quads[root];
        const auto at = [&](int i, int j) { return sample(table, root, i, n, j, m); };
        std::vector<Vec3> row, column, far_row, far_column;
        for (int i = 0; i <= n; ++i) row.push_back(at(i, 0)), far_row.push_back(at(i, m));
        for (int j = 0; j <= m; ++j) column.push_back(at(0, j)), far_column.push_back(at(n, j));
        const auto low = side(q.corners[0], q.corners[1], row), high = side(q.corners[3], q.corners[2], far_row);
        const auto left = side(q.corners[0], q.corners[3], column),
                   right = side(q.corners[1], q.corners[2], far_column);
        std::vector<std::uint32_t> ids;
        for (int j = 0; j <= m; ++j)
            for (int i = 0; i <= n; ++i) {
                const auto si = static_cast<std::size_t>(i), sj = static_cast<std::size_t>(j);
                ids.push_back(j == 0   ? low[si]
                              : j == m ? high[si]
                              : i == 0 ? left[sj]
                              : i == n ? right[sj]
                                       : add(at(i, j)));
            }
        add_faces(q, ids, n, m);
    }

    void add_faces(const CageQuad& q, const std::vector<std::uint32_t>& ids, int n, int m) {
        const auto id = [&](int i, int j) {
            return ids[static_cast<std::size_t>(j) * static_cast<std::size_t>(n + 1) + static_cast<std::size_t>(i)];
        };
        const auto uv = [&](int i, int j) {
            const double s = static_cast<double>(i) / n, t = static_cast<double>(j) / m;
            const auto mix = [&](double a, double b, double c, double d) {
                return (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * d + s * c);
            };
            return Uv{mix(q.uvs[0].u, q.uvs[1].u, q.uvs[2].u, q.uvs[3].u),
                      mix(q.uvs[0].v, q.uvs[1].v, q.uvs[2].v, q.uvs[3].v)};
        };
        for (int j = 0; j < m; ++j)
            for (int i = 0; i < n; ++i)
                out.surface.faces.push_back({{id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)},
                                             {uv(i, j), uv(i + 1, j), uv(i + 1, j + 1), uv(i, j + 1)},
                                             0,
                                             q.region});
    }
};

// Vertices of the midline: cage points at x = 0 and what lies on the border of the half between two of them.
std::vector<bool> midline_of(const Cage& half, const MirroredSurface& left) {
    std::map<Edge, int> uses;
    for (const CageQuad& q : half.quads)
        for (std::size_t k = 0; k < 4; ++k) ++uses[edge_of(q.corners[k], q.corners[(k + 1) % 4])];
    std::vector<bool> midline(left.surface.positions.size(), false);
    for (const auto& [edge, vertices] : left.edges)
        if (uses.at(edge) == 1 && half.points[edge.first].x == 0 && half.points[edge.second].x == 0)
            for (const auto v : vertices) midline[v] = true;
    return midline;
}

void mirror_surface(MirroredSurface& result, const std::vector<bool>& midline) {
    auto& positions = result.surface.positions;
    const std::size_t count = positions.size();
    result.mirror.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        result.mirror[i] = i;
        if (midline[i]) continue;
        result.mirror[i] = static_cast<std::uint32_t>(positions.size());
        positions.push_back(positions[i]);
        result.mirror.push_back(i);
    }
    const std::size_t faces = result.surface.faces.size();
    for (std::size_t f = 0; f < faces; ++f) {
        SurfaceFace face = result.surface.faces[f];
        for (auto& c : face.corners) c = result.mirror[c];
        for (Uv& uv : face.uvs) uv.u = 1 - uv.u;
        std::swap(face.corners[1], face.corners[3]);
        std::swap(face.uvs[1], face.uvs[3]);
        result.surface.faces.push_back(face);
    }
}

}  // namespace

MirroredSurface limit_surface(const Cage& half) {
    const Table table = limit_table(half);
    const EdgeCounts counts(half);
    MirroredSurface result;
    result.surface.positions.resize(half.points.size());
    Sampler sampler{half, table, result};
    for (std::uint32_t f = 0; f < half.quads.size(); ++f) {
        const auto& c = half.quads[f].corners;
        sampler.add_quad(f, counts(c[0], c[1]), counts(c[1], c[2]));
        for (std::size_t k = 0; k < 4; ++k)
            result.surface.positions[c[k]] = table[table_index(f, k == 1 || k == 2 ? cells : 0, k >= 2 ? cells : 0)];
    }
    mirror_surface(result, midline_of(half, result));
    return result;
}

std::vector<std::uint32_t> chain(const MirroredSurface& surface, const std::vector<std::uint32_t>& points) {
    std::vector<std::uint32_t> result{points.front()};
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        auto vertices = surface.edges.at(edge_of(points[i], points[i + 1]));
        if (points[i] > points[i + 1]) std::reverse(vertices.begin(), vertices.end());
        result.insert(result.end(), vertices.begin() + 1, vertices.end());
    }
    return result;
}

}  // namespace mien::samples
