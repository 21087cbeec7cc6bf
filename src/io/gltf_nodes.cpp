// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The node tree of glTF 2.0 (specification, 3.5): a node's matrix, or T · R · S; the world matrix is the parent's times
// its own. No recursion: chains of nodes may be as long as the file.

#include "io/gltf_nodes.hpp"

#include <cmath>
#include <fmt/format.h>
#include <string>
#include <utility>

#include "io/gltf_json.hpp"

namespace mien {

namespace {

using nlohmann::json;

std::string pointer_of(std::size_t node) {
    return fmt::format("/nodes/{}", node);
}

// Exporters write quaternions in few digits: the length is taken out. One of no length turns nothing.
Quaternion unit(const std::vector<double>& q) {
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (length == 0) return {};
    return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}

Affine local_map(const json& value, std::size_t number) {
    const Node node = read_node(value, number);
    return node.matrix ? *node.matrix : affine_map(node.translation, node.rotation, node.scale);
}

bool is_finite_map(const Affine& map) {
    return is_finite(map.columns[0]) && is_finite(map.columns[1]) && is_finite(map.columns[2]) && is_finite(map.offset);
}

struct Tree {
    std::vector<std::vector<std::size_t>> children;
    std::vector<std::size_t> parents;
};

Tree tree_of(const json& nodes) {
    Tree tree{std::vector<std::vector<std::size_t>>(nodes.size()), std::vector<std::size_t>(nodes.size(), no_parent)};
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const json& children = array_member(nodes[n], "children", pointer_of(n));
        for (std::size_t c = 0; c < children.size(); ++c) {
            const std::string pointer = fmt::format("{}/children/{}", pointer_of(n), c);
            const std::uint64_t child = whole_number(children[c], pointer);
            if (child >= nodes.size())
                fail_at(pointer, fmt::format("one of {} nodes", nodes.size()), std::to_string(child));
            if (tree.parents[child] != no_parent)
                fail_at(pointer, "a node without another parent",
                        fmt::format("node {}, a child of node {} too", child, tree.parents[child]));
            tree.parents[child] = n;
            tree.children[n].push_back(child);
        }
    }
    return tree;
}

// Depth first from these roots; what was visited before is passed by.
std::vector<std::size_t> depth_first(const Tree& tree, const std::vector<std::size_t>& roots) {
    std::vector<std::size_t> stack(roots.rbegin(), roots.rend());
    std::vector<bool> visited(tree.parents.size());
    std::vector<std::size_t> order;
    while (!stack.empty()) {
        const std::size_t node = stack.back();
        stack.pop_back();
        if (visited[node]) continue;
        visited[node] = true;
        order.push_back(node);
        stack.insert(stack.end(), tree.children[node].rbegin(), tree.children[node].rend());
    }
    return order;
}

std::vector<std::size_t> roots_of(const Tree& tree) {
    std::vector<std::size_t> roots;
    for (std::size_t n = 0; n < tree.parents.size(); ++n)
        if (tree.parents[n] == no_parent) roots.push_back(n);
    return roots;
}

// Every node has at most one parent, so whatever no root leads to lies on a cycle or below one.
void check_all_reached(const Tree& tree, const std::vector<std::size_t>& order) {
    std::vector<bool> reached(tree.parents.size());
    for (const std::size_t n : order) reached[n] = true;
    for (std::size_t n = 0; n < reached.size(); ++n)
        if (!reached[n]) fail_at(pointer_of(n), "a node that a root leads to", "a cycle");
}

std::vector<Affine> world_maps(const json& nodes, const Tree& tree) {
    const std::vector<std::size_t> order = depth_first(tree, roots_of(tree));
    check_all_reached(tree, order);
    std::vector<Affine> worlds(nodes.size());
    for (const std::size_t n : order) {
        const Affine local = local_map(nodes[n], n);
        worlds[n] = tree.parents[n] == no_parent ? local : worlds[tree.parents[n]] * local;
        if (!is_finite_map(worlds[n])) fail_at(pointer_of(n), "a finite transform", "one that runs over");
    }
    return worlds;
}

// The roots of the scene shown first; all roots where the document has no scene.
std::vector<std::size_t> scene_roots(const json& root, const Tree& tree) {
    const json& scenes = array_member(root, "scenes", "");
    if (scenes.empty()) return roots_of(tree);
    const std::uint64_t scene = whole_member(root, "scene", "", 0);
    if (scene >= scenes.size())
        fail_at("/scene", fmt::format("one of {} scenes", scenes.size()), std::to_string(scene));
    const std::string pointer = fmt::format("/scenes/{}", scene);
    std::vector<std::size_t> roots;
    for (const json& node : array_member(scenes[scene], "nodes", pointer)) {
        roots.push_back(whole_number(node, pointer + "/nodes"));
        if (roots.back() >= tree.parents.size())
            fail_found(pointer + "/nodes", fmt::format("one of {} nodes", tree.parents.size()), node);
    }
    return roots;
}

}  // namespace

Affine affine_from_columns(std::span<const double, 16> m) {
    return {{Vec3{m[0], m[1], m[2]}, Vec3{m[4], m[5], m[6]}, Vec3{m[8], m[9], m[10]}}, {m[12], m[13], m[14]}};
}

Node read_node(const json& value, std::size_t number) {
    const std::string pointer = pointer_of(number);
    Node node;
    node.name = text_member(value, "name", pointer);
    if (const auto matrix = find_numbers(value, "matrix", 16, pointer))
        node.matrix = affine_from_columns(std::span<const double, 16>(*matrix));
    if (const auto t = find_numbers(value, "translation", 3, pointer)) node.translation = {(*t)[0], (*t)[1], (*t)[2]};
    if (const auto r = find_numbers(value, "rotation", 4, pointer)) node.rotation = unit(*r);
    if (const auto s = find_numbers(value, "scale", 3, pointer)) node.scale = {(*s)[0], (*s)[1], (*s)[2]};
    return node;
}

SceneNodes scene_nodes(const GltfDocument& document) {
    const json& nodes = array_member(document.json, "nodes", "");
    const Tree tree = tree_of(nodes);
    std::vector<Affine> worlds = world_maps(nodes, tree);
    return {std::move(worlds), depth_first(tree, scene_roots(document.json, tree)), depth_first(tree, roots_of(tree)),
            tree.parents};
}

}  // namespace mien
