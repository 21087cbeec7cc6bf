// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/render/dress.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>

#include "render/geometry.hpp"

namespace mien {

namespace {

bool is_white(const Material& m) {
    return m.colour == std::array<float, 4>{1, 1, 1, 1} && !m.colour_picture;
}

// Says nothing that a file without materials would not.
bool is_plain(const Material& m) {
    const bool grey = m.colour[0] >= 0.6F && m.colour[0] == m.colour[1] && m.colour[1] == m.colour[2];
    const bool pictured = m.colour_picture || m.roughness_picture || m.normal_picture || m.emission_picture;
    return grey && !pictured && m.roughness >= 0.5F && (m.metallic == 0 || m.metallic == 1) &&
           m.emission == std::array<float, 3>{} && m.scatter == std::array<float, 3>{} &&
           m.alpha == Material::Alpha::opaque && !m.unlit && (m.name.empty() || m.name == "plain");
}

bool has_word(const std::string& name, std::string_view word) {
    const auto same = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b; };
    return std::search(name.begin(), name.end(), word.begin(), word.end(), same) != name.end();
}

struct Dress {
    std::string_view word;  // in the name of a surface
    std::array<float, 4> colour;
    float roughness;
    std::array<float, 3> scatter;
};
constexpr std::array<float, 3> skin_scatter{1, 0.42F, 0.28F};
// The first that fits; the last one fits all.
constexpr std::array<Dress, 10> wardrobe{{
    {"lash", {0.02F, 0.014F, 0.01F, 1}, 0.6F, {}},
    {"brow", {0.05F, 0.03F, 0.02F, 1}, 0.7F, {}},
    {"hair", {0.05F, 0.03F, 0.02F, 1}, 0.6F, {}},
    {"tongue", {0.48F, 0.17F, 0.16F, 1}, 0.3F, {0.8F, 0.4F, 0.3F}},
    {"gum", {0.45F, 0.15F, 0.14F, 1}, 0.28F, {0.8F, 0.4F, 0.3F}},
    {"teeth", {0.74F, 0.67F, 0.55F, 1}, 0.2F, {0.4F, 0.32F, 0.22F}},
    {"tooth", {0.74F, 0.67F, 0.55F, 1}, 0.2F, {0.4F, 0.32F, 0.22F}},
    {"eyelid", {0.58F, 0.345F, 0.26F, 1}, 0.46F, skin_scatter},
    {"eye", {0.78F, 0.75F, 0.72F, 1}, 0.15F, {}},
    {"", {0.58F, 0.345F, 0.26F, 1}, 0.46F, skin_scatter},
}};

const Dress& dress_for(const Surface& surface, bool on_eyeball) {
    const auto fits = [&](const Dress& dress) { return dress.word.empty() || has_word(surface.name, dress.word); };
    if (on_eyeball) return wardrobe[wardrobe.size() - 2];
    return *std::find_if(wardrobe.begin(), wardrobe.end(), fits);
}

// What the rig does with the vertices of each surface.
struct Use {
    std::size_t moved = 0, on_eyeball = 0, vertices = 0;
};
std::vector<Use> uses_of(const Scene& scene, const Rig* rig) {
    std::vector<Use> uses(scene.surfaces.size());
    for (std::size_t s = 0; s < uses.size(); ++s) uses[s].vertices = scene.surfaces[s].positions.size();
    if (rig == nullptr) return uses;
    std::vector<bool> on_eyeball(vertex_count(*rig), false);
    for (const Eyeball& eyeball : rig->eyeballs)
        for (const std::uint32_t v : eyeball.vertices) on_eyeball[v] = true;
    const std::vector<std::uint32_t> vertices = mesh_vertices(scene);
    std::size_t at = 0;
    for (Use& use : uses)
        for (std::size_t v = 0; v < use.vertices; ++v, ++at) {
            if (vertices[at] >= on_eyeball.size()) continue;
            use.on_eyeball += on_eyeball[vertices[at]] ? 1U : 0U;
            use.moved += rig->row_starts[vertices[at] + 1] > rig->row_starts[vertices[at]] ? 1U : 0U;
        }
    return uses;
}

// The material worn by most of the vertices that the rig moves.
std::optional<std::uint32_t> most_moved(const Scene& scene, const std::vector<Use>& uses) {
    std::vector<std::size_t> moved(scene.materials.size());
    for (std::size_t s = 0; s < uses.size(); ++s) moved[scene.surfaces[s].material] += uses[s].moved;
    const auto most = std::max_element(moved.begin(), moved.end());
    if (most == moved.end() || *most == 0) return std::nullopt;
    return static_cast<std::uint32_t>(most - moved.begin());
}

bool may_be_skin(const Material& m) {
    return m.metallic < 0.5F && m.alpha != Material::Alpha::blend && !m.unlit && m.scatter == std::array<float, 3>{};
}

bool is_called_skin(const Material& m) {
    constexpr std::array<std::string_view, 4> words{"skin", "head", "face", "body"};
    return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return has_word(m.name, word); });
}

}  // namespace

void dress(Scene& scene, const Rig* rig) {
    const std::vector<Use> uses = uses_of(scene, rig);
    const auto skin = most_moved(scene, uses);
    const std::size_t given = scene.materials.size();
    std::map<std::pair<std::uint32_t, const Dress*>, std::uint32_t> made;
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
        Surface& surface = scene.surfaces[s];
        if (!is_plain(scene.materials[surface.material])) continue;
        const Dress& dress = dress_for(surface, 2 * uses[s].on_eyeball > uses[s].vertices);
        const auto [found, is_new] =
            made.try_emplace({surface.material, &dress}, static_cast<std::uint32_t>(scene.materials.size()));
        if (is_new) {
            Material material = scene.materials[surface.material];
            material.colour = dress.colour;
            material.metallic = 0;
            material.roughness = dress.roughness;
            material.scatter = dress.scatter;
            scene.materials.push_back(material);
        }
        surface.material = found->second;
    }
    for (Material& material : scene.materials)
        if (material.alpha == Material::Alpha::blend && has_word(material.name, "cornea"))
            material.colour = {0, 0, 0, material.colour[3]};
    for (std::uint32_t m = 0; m < given; ++m)
        if (may_be_skin(scene.materials[m]) && (m == skin || is_called_skin(scene.materials[m]))) {
            if (is_white(scene.materials[m])) scene.materials[m].colour = wardrobe.back().colour;
            scene.materials[m].scatter = skin_scatter;
        }
}

}  // namespace mien
