// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Materials of glTF 2.0 (specification, 3.9), KHR_materials_unlit, KHR_materials_emissive_strength and
// KHR_texture_transform. A surface has one set of texture coordinates, so the pictures of a material have to lie alike;
// those that lie otherwise than the first, which is the colour where there is one, are left out.

#include "io/gltf_material.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>

#include "io/gltf_json.hpp"
#include "io/text.hpp"

namespace mien {

namespace {

using nlohmann::json;

constexpr int repeat = 10497;  // of a sampler's wrapS and wrapT

// A material while it is read.
struct Reading {
    Pictures& pictures;
    DocumentMaterial& out;
    bool any_picture = false;
};

float within(double number, double least, double most) {
    return static_cast<float>(std::clamp(number, least, most));
}

// Light without bound, but for what a float holds.
float from_zero(double number) {
    return within(number, 0, std::numeric_limits<float>::max());
}

void leave_out(Reading& reading, const std::string& what) {
    reading.pictures.left_out.push_back(fmt::format("{}: {}", reading.out.title, what));
}

PictureMapping mapping_of(const json& info, const std::string& pointer) {
    PictureMapping mapping;
    mapping.set = whole_member(info, "texCoord", pointer, 0);
    const json& extensions = object_member(info, "extensions", pointer);
    const std::string above = pointer + "/extensions", place = above + "/KHR_texture_transform";
    const json& transform = object_member(extensions, "KHR_texture_transform", above);
    mapping.set = whole_member(transform, "texCoord", place, mapping.set);
    mapping.rotation = number_member(transform, "rotation", place, 0);
    if (const auto offset = find_numbers(transform, "offset", 2, place)) mapping.offset = {(*offset)[0], (*offset)[1]};
    if (const auto scale = find_numbers(transform, "scale", 2, place)) mapping.scale = {(*scale)[0], (*scale)[1]};
    return mapping;
}

bool repeats(const json& root, std::size_t texture) {
    const auto sampler = find_whole(root["textures"][texture], "sampler", fmt::format("/textures/{}", texture));
    if (!sampler) return true;
    const std::string pointer = fmt::format("/samplers/{}", *sampler);
    const json& value = root["samplers"][*sampler];
    return whole_member(value, "wrapS", pointer, repeat) == repeat &&
           whole_member(value, "wrapT", pointer, repeat) == repeat;
}

// The picture that `owner` names, if it can be read and lies as those before it do.
std::optional<std::uint32_t> find_picture(Reading& reading, const json& owner, const char* name,
                                          const std::string& pointer) {
    const std::string below = fmt::format("{}/{}", pointer, name);
    if (find_member(owner, name, pointer) == nullptr) return std::nullopt;
    const json& info = object_member(owner, name, pointer);
    const std::size_t texture = whole_member(info, "index", below);
    const PictureMapping mapping = mapping_of(info, below);
    const std::optional<std::uint32_t> picture = picture_of(reading.pictures, texture);
    if (!picture) return std::nullopt;
    if (reading.any_picture && !(mapping == reading.out.mapping)) {
        leave_out(reading, fmt::format("{}, which lies otherwise than the pictures before it", name));
        return std::nullopt;
    }
    reading.any_picture = true;
    reading.out.mapping = mapping;
    reading.out.repeats = reading.out.repeats && repeats(reading.pictures.document.json, texture);
    return picture;
}

void read_surface(Reading& reading, const json& value, const std::string& above) {
    const json& surface = object_member(value, "pbrMetallicRoughness", above);
    const std::string pointer = above + "/pbrMetallicRoughness";
    Material& material = reading.out.material;
    if (const auto colour = find_numbers(surface, "baseColorFactor", 4, pointer))
        for (std::size_t c = 0; c < 4; ++c) material.colour[c] = within((*colour)[c], 0, 1);
    material.metallic = within(number_member(surface, "metallicFactor", pointer, 1), 0, 1);
    material.roughness = within(number_member(surface, "roughnessFactor", pointer, 1), 0, 1);
    material.colour_picture = find_picture(reading, surface, "baseColorTexture", pointer);
    material.roughness_picture = find_picture(reading, surface, "metallicRoughnessTexture", pointer);
}

void read_normals(Reading& reading, const json& value, const std::string& pointer) {
    Material& material = reading.out.material;
    material.normal_picture = find_picture(reading, value, "normalTexture", pointer);
    const json& info = object_member(value, "normalTexture", pointer);
    constexpr double most = std::numeric_limits<float>::max();
    material.normal_scale = within(number_member(info, "scale", pointer + "/normalTexture", 1), -most, most);
}

void read_emission(Reading& reading, const json& value, const std::string& pointer) {
    Material& material = reading.out.material;
    const std::string above = pointer + "/extensions", place = above + "/KHR_materials_emissive_strength";
    const json& extension =
        object_member(object_member(value, "extensions", pointer), "KHR_materials_emissive_strength", above);
    const double strength = number_member(extension, "emissiveStrength", place, 1);
    if (const auto emission = find_numbers(value, "emissiveFactor", 3, pointer))
        for (std::size_t c = 0; c < 3; ++c) material.emission[c] = from_zero((*emission)[c] * std::max(strength, 0.0));
    material.emission_picture = find_picture(reading, value, "emissiveTexture", pointer);
}

void read_alpha(Material& material, const json& value, const std::string& pointer) {
    const std::string mode = text_member(value, "alphaMode", pointer);
    if (mode == "MASK")
        material.alpha = Material::Alpha::mask;
    else if (mode == "BLEND")
        material.alpha = Material::Alpha::blend;
    else if (!mode.empty() && mode != "OPAQUE")
        fail_at(pointer + "/alphaMode", "OPAQUE, MASK or BLEND", shown(mode));
    material.alpha_cutoff = from_zero(number_member(value, "alphaCutoff", pointer, 0.5));
}

void name_the_rest(Reading& reading, const json& value, const std::string& pointer) {
    if (value.contains("occlusionTexture")) leave_out(reading, "occlusionTexture");
    for (const auto& [name, extension] : object_member(value, "extensions", pointer).items())
        if (name != "KHR_materials_unlit" && name != "KHR_materials_emissive_strength") leave_out(reading, shown(name));
}

}  // namespace

Vec2f mapped(const PictureMapping& mapping, const Vec2f& uv) {
    if (mapping == PictureMapping{mapping.set}) return uv;
    // Counter-clockwise as one sees it, while v runs downwards.
    const double c = std::cos(mapping.rotation), s = std::sin(mapping.rotation);
    const double u = mapping.scale[0] * uv.x, v = mapping.scale[1] * uv.y;
    return {static_cast<float>(mapping.offset[0] + c * u + s * v),
            static_cast<float>(mapping.offset[1] - s * u + c * v)};
}

DocumentMaterial read_material(Pictures& pictures, std::size_t number) {
    const std::string pointer = fmt::format("/materials/{}", number);
    const json& value = pictures.document.json["materials"][number];
    DocumentMaterial out;
    out.material.name = text_member(value, "name", pointer);
    out.title = out.material.name.empty() ? fmt::format("material {}", number)
                                          : fmt::format("material {} {}", number, shown(out.material.name));
    Reading reading{pictures, out};
    read_surface(reading, value, pointer);
    read_normals(reading, value, pointer);
    read_emission(reading, value, pointer);
    read_alpha(out.material, value, pointer);
    out.material.double_sided = bool_member(value, "doubleSided", pointer);
    out.material.unlit = object_member(value, "extensions", pointer).contains("KHR_materials_unlit");
    name_the_rest(reading, value, pointer);
    return out;
}

Material material_of_none() {
    Material material;
    material.metallic = 1;
    return material;
}

}  // namespace mien
