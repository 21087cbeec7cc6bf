// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A texture without a source is allowed (glTF 2.0, 5.29), but viewers stumble over a material that names one.

#include "io/gltf_missing.hpp"

#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mien {

namespace {

using nlohmann::json;

// The number that an object has under this name; exporters write 3.0 for 3 as well.
std::optional<std::size_t> find_number(const json& object, const char* name) {
    const auto found = object.is_object() ? object.find(name) : object.end();
    if (!object.is_object() || found == object.end() || !found->is_number()) return std::nullopt;
    const auto number = found->get<double>();
    if (!(number >= 0 && number < 1e9)) return std::nullopt;
    return static_cast<std::size_t>(number);
}

// Gives a source its new number, or takes it away with its picture; false where there is none any more.
bool keep_source(json& owner, const std::set<std::size_t>& gone) {
    const std::optional<std::size_t> source = find_number(owner, "source");
    if (!source) return false;
    if (gone.contains(*source)) {
        owner.erase("source");
        return false;
    }
    owner["source"] = *source - static_cast<std::size_t>(std::distance(gone.begin(), gone.lower_bound(*source)));
    return true;
}

// Extensions name pictures in other formats; one without its picture says nothing.
bool keep_sources(json& texture, const std::set<std::size_t>& gone) {
    bool any = keep_source(texture, gone);
    if (!texture.contains("extensions") || !texture["extensions"].is_object()) return any;
    json& extensions = texture["extensions"];
    for (auto extension = extensions.begin(); extension != extensions.end();) {
        const bool names_one = extension->is_object() && extension->contains("source");
        const bool kept = keep_source(*extension, gone);
        any = any || kept;
        extension = names_one && !kept ? extensions.erase(extension) : std::next(extension);
    }
    if (extensions.empty()) texture.erase("extensions");
    return any;
}

bool names_texture(const std::string& name, const json& value, const std::set<std::size_t>& textures) {
    constexpr std::string_view ending = "Texture";
    const bool is_one = name.size() >= ending.size() && name.substr(name.size() - ending.size()) == ending;
    const std::optional<std::size_t> texture = is_one ? find_number(value, "index") : std::nullopt;
    return texture && textures.contains(*texture);
}

// At any depth, extensions too.
void drop_textures(json& material, const std::set<std::size_t>& textures) {
    std::vector<json*> open{&material};
    while (!open.empty()) {
        json& object = *open.back();
        open.pop_back();
        for (auto member = object.begin(); member != object.end();) {
            const bool gone = object.is_object() && names_texture(member.key(), *member, textures);
            if (!gone && member->is_structured()) open.push_back(&*member);
            member = gone ? object.erase(member) : std::next(member);
        }
    }
}

}  // namespace

void drop_pictures(json& root, const std::set<std::size_t>& images) {
    if (images.empty()) return;
    json kept = json::array();
    for (std::size_t i = 0; i < root["images"].size(); ++i)
        if (!images.contains(i)) kept.push_back(std::move(root["images"][i]));
    root["images"] = std::move(kept);
    if (root["images"].empty()) root.erase("images");
    std::set<std::size_t> bare;
    for (std::size_t t = 0; root.contains("textures") && t < root["textures"].size(); ++t)
        if (!keep_sources(root["textures"][t], images)) bare.insert(t);
    for (std::size_t m = 0; root.contains("materials") && m < root["materials"].size(); ++m)
        drop_textures(root["materials"][m], bare);
}

}  // namespace mien
