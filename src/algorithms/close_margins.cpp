// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Closing by decree. Points close the middle of an eye; its corners stay open by a quarter of the way. So every place
// of the upper edge is sent to the place of the lower edge that it will lie over, and a sheet held at all of them
// spreads what that adds. Only what is missing goes through the sheet: the shape itself stays as smooth as its rig made
// it.

#include "algorithms/close_margins.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <queue>
#include <set>
#include <string_view>

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/rig_biharmonic.hpp"

namespace mien {

namespace {

Vec3 at_rest(const Face& face, const Weld& weld, std::uint32_t place) {
    return to_double(face.mesh.positions[weld.vertex[place]]);
}

// Edge places that are not shared, so that a sheet can hold each once.
std::vector<std::uint32_t> handles_of(const std::vector<Margin>& margins) {
    std::set<std::uint32_t> handles;
    for (const Margin& margin : margins) {
        handles.insert(margin.upper.begin(), margin.upper.end());
        handles.insert(margin.lower.begin(), margin.lower.end());
    }
    return {handles.begin(), handles.end()};
}

bool is_fold(std::string_view id) {
    return id == "3.9" || id == "3.10" || id == "3.13" || id == "3.14";
}

}  // namespace

MarginCloser fit_margin_closer(const Face& face, const Weld& weld, const EdgeGraph& graph) {
    MarginCloser closer{find_margins(face, weld, graph), {}, {}};
    if (closer.margins.empty()) return closer;
    Face held{face.mesh, {}};
    std::set<std::uint32_t> taken;
    for (const std::uint32_t place : handles_of(closer.margins)) {
        held.points.push_back({fmt::format("edge {}", place), weld.vertex[place], at_rest(face, weld, place), {}, 0});
        closer.places.push_back(place);
        taken.insert(place);
    }
    for (const FeaturePoint& point : face.points) {
        if (is_fold(point.id) || !taken.insert(weld.place[point.vertex]).second) continue;
        held.points.push_back(point);
        held.points.back().moves = {};
        closer.places.push_back(weld.place[point.vertex]);
    }
    BiharmonicOptions all;
    all.influences = 0;
    closer.sheet = rig_biharmonic(held, all);
    return closer;
}

namespace {

// An edge as it lies once the field has moved it, and where that is along the chord between the corners at rest.
struct MovedEdge {
    std::vector<std::uint32_t> places;
    std::vector<double> along;
};

MovedEdge moved_edge(const std::vector<std::uint32_t>& edge, const Face& face, const Weld& weld,
                     const ShapeField& field) {
    MovedEdge moved{edge, {}};
    const Vec3 first = at_rest(face, weld, edge.front()), chord = at_rest(face, weld, edge.back()) - first;
    for (const std::uint32_t p : edge)
        moved.along.push_back(dot(at_rest(face, weld, p) + field[p] - first, chord) / dot(chord, chord));
    return moved;
}

// From a place of one edge to the other edge where it is met after the motion, less the same at rest where asked for.
Vec3 way_to(const MovedEdge& other, std::uint32_t place, double along, const Face& face, const Weld& weld,
            Closing closing, const ShapeField& field) {
    const double low = std::min(other.along.front(), other.along.back());
    const double high = std::max(other.along.front(), other.along.back());
    const OnEdge met = on_edge(other.places, other.along, std::clamp(along, low, high));
    const auto rest = [&](std::uint32_t p) { return at_rest(face, weld, p); };
    const auto moved = [&](std::uint32_t p) { return at_rest(face, weld, p) + field[p]; };
    const Vec3 way = value_on(met, moved) - moved(place);
    return closing == Closing::touch ? way : way - (value_on(met, rest) - rest(place));
}

ShapeField drawn(const MarginCloser& closer, const Weld& weld, const std::vector<Vec3f>& moves) {
    std::vector<Vec3f> moved(vertex_count(closer.sheet));
    deform(closer.sheet, moves, moved);
    ShapeField field;
    for (const std::uint32_t v : weld.vertex) field.push_back(to_double(moved[v]) - to_double(closer.sheet.rest[v]));
    return field;
}

}  // namespace

void close_margin(const MarginCloser& closer, const Face& face, const Weld& weld, std::size_t margin, Closing closing,
                  double upper, ShapeField& field) {
    const Margin& slit = closer.margins[margin];
    const MovedEdge above = moved_edge(slit.upper, face, weld, field);
    const MovedEdge below = moved_edge(slit.lower, face, weld, field);
    std::vector<Vec3f> moves(closer.places.size());
    const auto send = [&](const MovedEdge& edge, const MovedEdge& other, double share) {
        for (std::size_t i = 1; i + 1 < edge.places.size(); ++i) {
            const std::uint32_t p = edge.places[i];
            if (std::find(other.places.begin(), other.places.end(), p) != other.places.end()) continue;
            const auto handle = std::find(closer.places.begin(), closer.places.end(), p) - closer.places.begin();
            moves[static_cast<std::size_t>(handle)] =
                to_float(share * way_to(other, p, edge.along[i], face, weld, closing, field));
        }
    };
    send(above, below, upper);
    send(below, above, 1 - upper);
    const ShapeField add = drawn(closer, weld, moves);
    for (std::uint32_t p = 0; p < field.size(); ++p) field[p] += add[p];
}

namespace {

// What is missing of an even arch along one edge, at the sheet's handles. `middle`: the place of its feature point.
void add_arch(const MarginCloser& closer, const Face& face, const Weld& weld, const std::vector<std::uint32_t>& edge,
              std::uint32_t middle, const ShapeField& field, std::vector<Vec3f>& moves) {
    const std::vector<double> along = along_chord(edge, face, weld);
    const auto at = static_cast<std::size_t>(std::find(edge.begin(), edge.end(), middle) - edge.begin());
    if (at >= along.size() || !(along[at] > 0 && along[at] < 1)) return;
    const auto straight = [&](double t) { return (1 - t) * field[edge.front()] + t * field[edge.back()]; };
    const Vec3 bow = field[middle] - straight(along[at]);
    for (std::size_t i = 1; i + 1 < edge.size(); ++i) {
        const double t = along[i] < along[at] ? along[i] / along[at] : (1 - along[i]) / (1 - along[at]);
        const Vec3 wanted = straight(along[i]) + (t * (2 - t)) * bow;
        const auto handle = std::find(closer.places.begin(), closer.places.end(), edge[i]) - closer.places.begin();
        moves[static_cast<std::size_t>(handle)] = to_float(wanted - field[edge[i]]);
    }
}

}  // namespace

void arch_edges(const MarginCloser& closer, const Face& face, const Weld& weld, std::size_t margin, ShapeField& field) {
    const Margin& slit = closer.margins[margin];
    const auto middle = [&](std::size_t edge) { return weld.place[face.points[slit.points[edge]].vertex]; };
    std::vector<Vec3f> moves(closer.places.size());
    add_arch(closer, face, weld, slit.upper, middle(0), field, moves);
    add_arch(closer, face, weld, slit.lower, middle(1), field, moves);
    const ShapeField add = drawn(closer, weld, moves);
    for (std::uint32_t p = 0; p < field.size(); ++p) field[p] += add[p];
}

ShapeField drawn_by_edges(const MarginCloser& closer, const Weld& weld, const ShapeField& field) {
    std::vector<Vec3f> moves;
    for (const std::uint32_t p : closer.places) moves.push_back(to_float(field[p]));
    return drawn(closer, weld, moves);
}

namespace {

constexpr double pocket_depth = 0.15;  // in eye distances

// Every place that is reached from `start` without crossing the edges.
std::vector<std::uint32_t> enclosed(const EdgeGraph& graph, const std::vector<bool>& is_edge, std::uint32_t start,
                                    std::vector<bool>& seen) {
    std::vector<std::uint32_t> reached{start};
    seen[start] = true;
    for (std::size_t i = 0; i < reached.size(); ++i)
        for (std::uint32_t e = graph.starts[reached[i]]; e < graph.starts[reached[i] + 1]; ++e) {
            const std::uint32_t n = graph.neighbours[e];
            if (seen[n] || is_edge[n]) continue;
            seen[n] = true;
            reached.push_back(n);
        }
    return reached;
}

// For every place within the depth the nearest place of the edges and how far it is.
void add_followers(const EdgeGraph& graph, const std::vector<std::uint32_t>& edges, const std::vector<bool>& in_pocket,
                   double depth, std::vector<PocketPlace>& pockets) {
    struct Reached {
        double distance;
        std::uint32_t place, edge;
        bool operator>(const Reached& other) const {
            return std::tie(distance, place, edge) > std::tie(other.distance, other.place, other.edge);
        }
    };
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
    std::vector<bool> done(in_pocket.size(), false);
    for (const std::uint32_t p : edges) front.push({0, p, p});
    while (!front.empty()) {
        const Reached here = front.top();
        front.pop();
        if (done[here.place]) continue;
        done[here.place] = true;
        if (here.distance > 0) {
            const double t = std::min(1.0, here.distance / depth);
            pockets.push_back({here.place, here.edge, 1 - t * t * (3 - 2 * t)});
        }
        for (std::uint32_t e = graph.starts[here.place]; e < graph.starts[here.place + 1]; ++e)
            if (in_pocket[graph.neighbours[e]])
                front.push({here.distance + graph.lengths[e], graph.neighbours[e], here.edge});
    }
}

}  // namespace

std::vector<PocketPlace> eye_pockets(const Face& face, const Weld& weld, const EdgeGraph& graph,
                                     const std::vector<Margin>& margins) {
    std::vector<bool> holds_point(weld.vertex.size(), false);
    for (const FeaturePoint& point : face.points) holds_point[weld.place[point.vertex]] = true;
    std::vector<PocketPlace> pockets;
    for (const Margin& margin : margins) {
        if (margin.kind == Margin::Kind::lips) continue;
        std::vector<bool> is_edge(weld.vertex.size(), false), in_pocket(weld.vertex.size(), false);
        const std::vector<std::uint32_t> edges = handles_of({margin});
        for (const std::uint32_t p : edges) is_edge[p] = true;
        std::vector<bool> seen(weld.vertex.size(), false);
        for (const std::uint32_t p : edges)
            for (std::uint32_t e = graph.starts[p]; e < graph.starts[p + 1]; ++e) {
                const std::uint32_t n = graph.neighbours[e];
                if (seen[n] || is_edge[n]) continue;
                const std::vector<std::uint32_t> part = enclosed(graph, is_edge, n, seen);
                if (std::any_of(part.begin(), part.end(), [&](std::uint32_t q) { return holds_point[q]; })) continue;
                for (const std::uint32_t q : part) in_pocket[q] = true;
            }
        add_followers(graph, edges, in_pocket, pocket_depth * eye_distance(face.points), pockets);
    }
    return pockets;
}

void follow_edges(const std::vector<PocketPlace>& pockets, ShapeField& field) {
    for (const PocketPlace& pocket : pockets) field[pocket.place] = pocket.share * field[pocket.edge];
}

namespace {

constexpr double clearance = 1.01;  // of the eyeball's radius
constexpr double sharpness = 90;    // of how an eyeball's vertices say how large it is in a direction: within 8 degrees
constexpr double reach = 1.6;       // of the eyeball's radius: skin beyond is not at the eye
constexpr double behind = 0.85;     // of the radius: skin at rest nearer to the centre is not before the eye

// An eyeball as vertices seen from its centre.
struct Ball {
    Vec3 centre;
    std::vector<Vec3> surface;
    double largest = 0;
};

// How far its surface lies from its centre in a direction of length 1: smooth, where a pupil or a cornea stands out
// too.
double radius_towards(const Ball& ball, const Vec3& direction) {
    double sum = 0, weights = 1e-300;
    for (const Vec3& p : ball.surface) {
        const double r = length(p);
        const double weight = r > 0.5 * ball.largest ? std::exp(sharpness * (dot(p, direction) / r - 1)) : 0;
        sum += weight * r;
        weights += weight;
    }
    return sum / weights;
}

// Each eyeball at rest and as a field turns it.
struct Turned {
    Ball rest, moved;
};

std::vector<Turned> eyeballs(const Face& face, const Weld& weld, const Rig& rig, const ShapeField& field) {
    std::vector<Turned> balls;
    for (const Eyeball& eyeball : rig.eyeballs) {
        Turned& ball = balls.emplace_back();
        ball.rest.centre = ball.moved.centre = eyeball.centre;
        for (const std::uint32_t v : eyeball.vertices) {
            const Vec3 arm = to_double(face.mesh.positions[v]) - eyeball.centre;
            ball.rest.surface.push_back(arm);
            ball.moved.surface.push_back(arm + field[weld.place[v]]);
            ball.rest.largest = std::max(ball.rest.largest, length(arm));
        }
        ball.moved.largest = ball.rest.largest;
    }
    return balls;
}

// Sends a place out along the line from the eyeball's centre until it is at that share of the radius there.
void keep_at(const Ball& ball, double share, const Vec3& rest, Vec3& delta) {
    const Vec3 moved = rest + delta;
    const double after = length(moved);
    if (!(after > 0) || after > share * ball.largest) return;
    const double least = share * radius_towards(ball, moved / after);
    if (after < least) delta = (least / after) * moved - rest;
}

}  // namespace

void keep_out_of_eyeballs(const Face& face, const Weld& weld, const Rig& rig, ShapeField& field) {
    std::vector<bool> is_eye(weld.vertex.size(), false);
    for (const Eyeball& eyeball : rig.eyeballs)
        for (const std::uint32_t v : eyeball.vertices) is_eye[weld.place[v]] = true;
    for (const Turned& ball : eyeballs(face, weld, rig, field))
        for (std::uint32_t p = 0; p < field.size(); ++p) {
            if (is_eye[p] || field[p] == Vec3{}) continue;
            const Vec3 rest = at_rest(face, weld, p) - ball.rest.centre;
            const double before = length(rest);
            if (before > reach * ball.rest.largest || !(before > 0)) continue;
            const double share = before / radius_towards(ball.rest, rest / before);
            if (share > behind) keep_at(ball.moved, std::min(share, clearance), rest, field[p]);
        }
}

void edges_before_eyeballs(const Margin& margin, const Face& face, const Weld& weld, const Rig& rig,
                           ShapeField& field) {
    const std::vector<Turned> balls = eyeballs(face, weld, rig, field);
    for (const std::uint32_t p : handles_of({margin}))
        for (const Turned& ball : balls) {
            const Vec3 rest = at_rest(face, weld, p) - ball.rest.centre;
            // The corners stay: both edges end there.
            const bool corner = p == margin.upper.front() || p == margin.upper.back();
            if (!corner && length(rest) < reach * ball.rest.largest) keep_at(ball.moved, clearance, rest, field[p]);
        }
}

}  // namespace mien
