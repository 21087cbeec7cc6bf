// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/check_shapes.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

#include "algorithms/flipped_faces.hpp"
#include "algorithms/margins.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::size_t places_along_a_slit = 19;

using Positions = std::vector<Vec3f>;

const MorphTarget* find(std::span<const MorphTarget> shapes, std::string_view name) {
    const auto found = std::find_if(shapes.begin(), shapes.end(), [&](const MorphTarget& s) { return s.name == name; });
    return found == shapes.end() ? nullptr : &*found;
}

void add(const MorphTarget& shape, Positions& positions) {
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) positions[shape.vertices[i]] += shape.deltas[i];
}

struct Ruler {
    const Face& face;
    const Weld& weld;
    const Margin& margin;
};

std::vector<double> openings(const Ruler& ruler, const Positions& positions) {
    const auto at = [&](std::uint32_t p) { return to_double(positions[ruler.weld.vertex[p]]); };
    return openings(ruler.margin, at, places_along_a_slit);
}

Openness range(const std::vector<double>& values, double whole) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return {*most / whole, *least / whole};
}

void check_slit(const Ruler& ruler, std::span<const MorphTarget> shapes, ShapesCheck& check) {
    const Positions& rest = ruler.face.mesh.positions;
    const std::vector<double> at_rest = openings(ruler, rest);
    const bool lips = ruler.margin.kind == Margin::Kind::lips;
    const bool left = ruler.margin.kind == Margin::Kind::left_lids;
    const MorphTarget* shape = find(shapes, lips ? "jawOpen" : left ? "eyeBlinkLeft" : "eyeBlinkRight");
    const MorphTarget* close = find(shapes, "mouthClose");
    if (shape == nullptr || (lips && close == nullptr)) return;
    Positions moved = rest;
    add(*shape, moved);
    std::vector<double> left_open = openings(ruler, moved);
    if (!lips) {
        const double height = *std::max_element(at_rest.begin(), at_rest.end());
        if (height > 0) (left ? check.blink_left : check.blink_right) = range(left_open, height);
        return;
    }
    const std::size_t middle = places_along_a_slit / 2;
    const double opened = left_open[middle] - at_rest[middle];
    add(*close, moved);
    left_open = openings(ruler, moved);
    for (std::size_t i = 0; i < left_open.size(); ++i) left_open[i] -= at_rest[i];
    if (opened > 0) check.closed_jaw = range(left_open, opened);
}

Vec3 motion_of(const MorphTarget& shape, std::uint32_t vertex) {
    const auto found = std::lower_bound(shape.vertices.begin(), shape.vertices.end(), vertex);
    if (found == shape.vertices.end() || *found != vertex) return {};
    return to_double(shape.deltas[static_cast<std::size_t>(found - shape.vertices.begin())]);
}

std::optional<double> upper_lip_share(const Face& face, std::span<const MorphTarget> shapes) {
    const MorphTarget* open = find(shapes, "jawOpen");
    const auto upper = find_point(face.points, "2.2"), lower = find_point(face.points, "2.3");
    if (open == nullptr || !upper || !lower) return std::nullopt;
    const double moves = length(motion_of(*open, face.points[*lower].vertex));
    if (!(moves > 0)) return std::nullopt;
    return length(motion_of(*open, face.points[*upper].vertex)) / moves;
}

void count_flipped(const Face& face, std::span<const MorphTarget> shapes, ShapesCheck& check) {
    const double least = least_motion * eye_distance(face.points);
    const Positions& rest = face.mesh.positions;
    FlippedFaces all;
    for (const MorphTarget& shape : shapes) {
        Positions positions = rest;
        add(shape, positions);
        const MorphTarget* with = shape.name == "mouthClose" ? find(shapes, "jawOpen") : nullptr;
        if (with != nullptr) add(*with, positions);
        const FlippedFaces faces = flipped_faces(face.mesh, rest, positions, least);
        all += faces;
        if (share(faces) <= check.most_flipped_share) continue;
        check.most_flipped_share = share(faces);
        check.most_flipped = shape.name;
    }
    check.flipped = share(all);
}

}  // namespace

ShapesCheck check_shapes(const Face& face, std::span<const MorphTarget> shapes) {
    for (const MorphTarget& shape : shapes)
        if (!shape.vertices.empty() && shape.vertices.back() >= vertex_count(face.mesh))
            throw Error(fmt::format("shape \"{}\": expected vertices below {}, found {}", shape.name,
                                    vertex_count(face.mesh), shape.vertices.back()));
    ShapesCheck check;
    const Weld joined = weld(face.mesh);
    const EdgeGraph graph = edge_graph(face.mesh, joined);
    for (const Margin& margin : find_margins(face, joined, graph)) check_slit({face, joined, margin}, shapes, check);
    check.upper_lip = upper_lip_share(face, shapes);
    count_flipped(face, shapes, check);
    return check;
}

}  // namespace mien
