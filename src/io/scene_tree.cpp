// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/scene_tree.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <utility>

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::size_t most_nested = 24;
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

[[noreturn]] void fail(const FatNode& node, std::string_view sentence) {
    throw Error(fmt::format("fdp text, node {}: {}", node.name, sentence));
}

// The faces of a node; it has to hold all corners of a face or none, and no vertices without faces.
std::vector<std::uint32_t> faces_of(const Mesh& mesh, const FatNode& node) {
    std::vector<bool> inside(vertex_count(mesh)), used(vertex_count(mesh));
    for (const std::uint32_t v : node.vertices) inside[v] = true;
    std::vector<std::uint32_t> faces;
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        const std::span<const std::uint32_t> corners = face(mesh, f);
        const auto count = std::count_if(corners.begin(), corners.end(), [&](std::uint32_t v) { return inside[v]; });
        if (count == 0) continue;
        if (count != std::ssize(corners))
            fail(node, fmt::format("expected whole faces, found face {} partly in it", f));
        faces.push_back(static_cast<std::uint32_t>(f));
        for (const std::uint32_t v : corners) used[v] = true;
    }
    if (faces.size() == face_count(mesh)) used.assign(used.size(), true);
    if (used != inside) fail(node, "expected the vertices of its faces, or of the whole head, found others");
    return faces;
}

struct Nesting {
    std::vector<std::uint32_t> innermost;           // per face: the node that it lies in first, or none
    std::vector<std::vector<std::uint32_t>> nodes;  // per node those right in it; last the scene's
};

Nesting nesting(const Mesh& mesh, const Fat& fat) {
    const std::size_t count = fat.nodes.size();
    Nesting nesting{std::vector<std::uint32_t>(face_count(mesh), none),
                    std::vector<std::vector<std::uint32_t>>(count + 1)};
    std::vector<std::uint32_t> outermost = nesting.innermost;
    std::vector<std::size_t> sizes(count), depths(count);
    std::vector<bool> is_inner(count);
    for (std::uint32_t n = 0; n < count; ++n) {
        std::map<std::uint32_t, std::size_t> held;  // outermost nodes so far, and how many of their faces
        const std::vector<std::uint32_t> faces = faces_of(mesh, fat.nodes[n]);
        for (const std::uint32_t f : faces) {
            if (outermost[f] != none) ++held[outermost[f]];
            if (nesting.innermost[f] == none) nesting.innermost[f] = n;
            outermost[f] = n;
        }
        sizes[n] = faces.size();
        for (const auto& [inner, size] : held) {
            if (size != sizes[inner])
                fail(fat.nodes[n], fmt::format("expected nodes apart or in each other, found it partly in {}",
                                               fat.nodes[inner].name));
            nesting.nodes[n].push_back(inner);
            is_inner[inner] = true;
            depths[n] = std::max(depths[n], depths[inner] + 1);
        }
        if (depths[n] >= most_nested)
            fail(fat.nodes[n], fmt::format("expected nodes at most {} deep, found deeper ones", most_nested));
    }
    for (std::uint32_t n = 0; n < count; ++n)
        if (!is_inner[n]) nesting.nodes[count].push_back(n);
    return nesting;
}

std::vector<std::uint32_t> part_of_faces(const Mesh& mesh) {
    std::vector<std::uint32_t> parts(face_count(mesh), none);
    for (std::uint32_t p = 0; p < mesh.parts.size(); ++p)
        for (std::size_t f = 0; f < mesh.parts[p].face_count; ++f) parts[mesh.parts[p].first_face + f] = p;
    return parts;
}

}  // namespace

SceneTree scene_tree(const Mesh& mesh, const Fat& fat) {
    Nesting nested = nesting(mesh, fat);
    const std::vector<std::uint32_t> parts = part_of_faces(mesh);
    const auto scene = static_cast<std::uint32_t>(fat.nodes.size());
    SceneTree tree{std::vector<TreeNode>(scene + 1U)};
    for (std::size_t n = 0; n <= scene; ++n) tree.nodes[n].nodes = std::move(nested.nodes[n]);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> known;  // node and part: its shape
    for (std::uint32_t f = 0; f < face_count(mesh); ++f) {
        const std::uint32_t node = nested.innermost[f] == none ? scene : nested.innermost[f];
        std::vector<TreeShape>& shapes = tree.nodes[node].shapes;
        const auto [found, is_new] = known.emplace(std::pair(node, parts[f]), shapes.size());
        if (is_new) shapes.push_back({parts[f] == none ? "head" : mesh.parts[parts[f]].name, {}});
        shapes[found->second].faces.push_back(f);
    }
    if (face_count(mesh) == 0 && (vertex_count(mesh) > 0 || !fat.tables.empty()))
        tree.nodes[scene].shapes.push_back({"head", {}});
    return tree;
}

}  // namespace mien
