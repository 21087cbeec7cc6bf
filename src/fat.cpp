// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/fat.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <span>
#include <utility>

#include "mien/error.hpp"

namespace mien {

namespace {

// Of visemes and of expressions, which are numbered from 1.
int selects(int fap) {
    return static_cast<int>(fap == 1 ? viseme_names.size() : fap == 2 ? expression_names.size() : 1) - 1;
}

[[noreturn]] void fail(const FaceDefTables& table, std::string_view sentence) {
    throw Error(table.high_level_select > 0 ? fmt::format("face animation table, FAP {} select {}: {}", table.fap,
                                                          table.high_level_select, sentence)
                                            : fmt::format("face animation table, FAP {}: {}", table.fap, sentence));
}

template <class T>
bool is_ascending(std::span<const T> numbers) {
    return std::adjacent_find(numbers.begin(), numbers.end(), [](T a, T b) { return a >= b; }) == numbers.end();
}

void check_vertices(const FaceDefTables& table, std::span<const std::uint32_t> of, std::size_t vertices) {
    if (!is_ascending(of)) fail(table, "expected vertices that ascend, found others");
    if (!of.empty() && of.back() >= vertices)
        fail(table, fmt::format("expected vertices below {}, found {}", vertices, of.back()));
}

void check_mesh(const FaceDefTables& table, const FaceDefMesh& mesh, std::size_t vertices) {
    if (mesh.borders.size() < 2)
        fail(table, fmt::format("expected two interval borders or more, found {}", mesh.borders.size()));
    if (!is_ascending(std::span(mesh.borders)) ||
        std::find(mesh.borders.begin(), mesh.borders.end(), 0) == mesh.borders.end())
        fail(table,
             fmt::format("expected interval borders that ascend through 0, found {}",
                         fmt::join(mesh.borders.begin(),
                                   mesh.borders.begin() + std::min<std::ptrdiff_t>(std::ssize(mesh.borders), 8), " ")));
    check_vertices(table, mesh.vertices, vertices);
    const std::size_t intervals = mesh.borders.size() - 1;
    if (mesh.displacements.size() / intervals != mesh.vertices.size() || mesh.displacements.size() % intervals != 0)
        fail(table, fmt::format("expected {} displacements, one per vertex and interval, found {}",
                                mesh.vertices.size() * intervals, mesh.displacements.size()));
    if (!std::all_of(mesh.displacements.begin(), mesh.displacements.end(), is_finite<float>))
        fail(table, "expected displacements that are finite, found others");
}

void check_transform(const FaceDefTables& table, const FaceDefTransform& transform, std::size_t nodes) {
    if (transform.node >= nodes) fail(table, fmt::format("expected a node below {}, found {}", nodes, transform.node));
    if (!is_finite(transform.axis) || !std::isfinite(transform.angle) || !is_finite(transform.translation) ||
        !is_finite(transform.scale))
        fail(table, "expected transforms that are finite, found others");
    if (transform.field == TransformField::rotation && std::abs(length(transform.axis) - 1) > 1e-6)
        fail(table, fmt::format("expected an axis of length 1, found {}", length(transform.axis)));
}

void check_table(const FaceDefTables& table, const Fat& fat, std::size_t vertices) {
    if (table.fap < 1 || table.fap > static_cast<int>(fap_count))
        throw Error(fmt::format("face animation table: expected a FAP from 1 to {}, found {}", fap_count, table.fap));
    const int most = selects(table.fap);
    if (table.high_level_select < (most > 0 ? 1 : 0) || table.high_level_select > most)
        throw Error(fmt::format("face animation table, FAP {}: expected a high level select from {} to {}, found {}",
                                table.fap, most > 0 ? 1 : 0, most, table.high_level_select));
    for (const FaceDefMesh& mesh : table.meshes) check_mesh(table, mesh, vertices);
    for (const FaceDefTransform& transform : table.transforms) check_transform(table, transform, fat.nodes.size());
}

void check_node(const FatNode& node, std::size_t vertices) {
    const bool in_range = node.vertices.empty() || node.vertices.back() < vertices;
    if (!is_ascending(std::span(node.vertices)) || !in_range || !is_finite(node.centre))
        throw Error(
            fmt::format("face animation table, node {}: expected ascending vertices below {} and a centre that "
                        "is finite, found others",
                        node.name, vertices));
}

}  // namespace

void check_fat(const Fat& fat, std::size_t vertices) {
    for (const FatNode& node : fat.nodes) check_node(node, vertices);
    for (std::size_t i = 0; i < fat.tables.size(); ++i) {
        const FaceDefTables& table = fat.tables[i];
        check_table(table, fat, vertices);
        if (i == 0) continue;
        const FaceDefTables& before = fat.tables[i - 1];
        if (std::pair(before.fap, before.high_level_select) >= std::pair(table.fap, table.high_level_select))
            fail(table, "expected tables that ascend by FAP, each once, found another order");
    }
}

}  // namespace mien
