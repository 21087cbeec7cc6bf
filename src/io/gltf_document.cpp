// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// glTF 2.0 (specification, 3.2 to 3.6) made self-contained: buffers from the BIN chunk, data: URIs and files beside the
// document become one binary, each at a multiple of four bytes so that what was aligned stays aligned.

#include "io/gltf_document.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "io/gltf_json.hpp"
#include "io/gltf_missing.hpp"
#include "io/gltf_references.hpp"
#include "io/gltf_uri.hpp"
#include "io/json_text.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

using nlohmann::json;
using Bytes = std::span<const std::byte>;

constexpr const char* meshopt = "EXT_meshopt_compression";

void check_asset(const json& root) {
    if (!root.contains("asset")) fail_at("/asset", "an object", "none");
    const std::string version = text_member(root["asset"], "version", "/asset");
    if (version.substr(0, 2) != "2.") fail_at("/asset/version", "2.0", shown(version));
}

void check_arrays(const json& root) {
    for (const char* name : {"accessors", "animations", "buffers", "bufferViews", "cameras", "images", "materials",
                             "meshes", "nodes", "samplers", "scenes", "skins", "textures"}) {
        const json& array = array_member(root, name, "");
        for (std::size_t i = 0; i < array.size(); ++i)
            if (!array[i].is_object()) fail_found(fmt::format("/{}/{}", name, i), "an object", array[i]);
    }
}

// Extensions that change no geometry and survive on the way out are supported as well.
bool is_supported(std::string_view extension) {
    constexpr std::array supported{
        std::string_view("KHR_mesh_quantization"),      std::string_view("EXT_meshopt_compression"),
        std::string_view("KHR_draco_mesh_compression"), std::string_view("KHR_texture_transform"),
        std::string_view("EXT_texture_webp"),           std::string_view("KHR_texture_basisu")};
    return extension.substr(0, 14) == "KHR_materials_" ||
           std::find(supported.begin(), supported.end(), extension) != supported.end();
}

void check_extensions(const json& root) {
    const json& required = array_member(root, "extensionsRequired", "");
    for (std::size_t i = 0; i < required.size(); ++i)
        if (!required[i].is_string() || !is_supported(required[i].get_ref<const std::string&>()))
            fail_found(fmt::format("/extensionsRequired/{}", i), "an extension that is supported", required[i]);
}

// Where something lies in the binary.
struct Place {
    enum class State { there, absent, fallback };
    State state = State::there;
    std::size_t offset = 0;
    std::size_t size = 0;
};

// The binary while it grows. What is named twice is fetched once, so that a short text cannot ask for much.
struct Growing {
    std::vector<std::byte>& binary;
    const Fetch& fetch;
    std::map<std::string, Place> fetched;
};

Place append(std::vector<std::byte>& binary, Bytes content, const std::string& pointer) {
    const std::uint64_t offset = (std::uint64_t{binary.size()} + 3) / 4 * 4;
    if (offset + content.size() > std::numeric_limits<std::uint32_t>::max())
        fail_at(pointer, "less than 4 GiB in all", fmt::format("{} bytes", offset + content.size()));
    binary.resize(offset);
    binary.insert(binary.end(), content.begin(), content.end());
    return {Place::State::there, offset, content.size()};
}

Place place_uri(Growing& out, const std::string& uri, const std::string& pointer) {
    if (is_data_uri(uri)) return append(out.binary, decode_data_uri(uri, pointer), pointer);
    const std::string path = relative_path(uri, pointer);
    const auto known = out.fetched.find(path);
    if (known != out.fetched.end()) return known->second;
    const Place place = append(out.binary, out.fetch(path), pointer);
    out.fetched.emplace(path, place);
    return place;
}

bool is_fallback(const json& buffer, const std::string& pointer) {
    const json& extensions = object_member(buffer, "extensions", pointer);
    const json& own = object_member(extensions, meshopt, pointer + "/extensions");
    return bool_member(own, "fallback", pointer + "/extensions/" + meshopt);
}

// The BIN chunk is the first buffer's and lies at the beginning already.
Place place_buffer(Growing& out, const json& buffer, const std::string& pointer, bool is_bin, std::size_t bin_size) {
    const std::uint64_t size = whole_member(buffer, "byteLength", pointer);
    const json* uri = find_member(buffer, "uri", pointer);
    if (uri == nullptr && is_fallback(buffer, pointer)) return {Place::State::fallback, 0, 0};
    if (uri == nullptr && !is_bin) return {Place::State::absent, 0, 0};
    const Place place = uri == nullptr ? Place{Place::State::there, 0, bin_size}
                                       : place_uri(out, text_member(buffer, "uri", pointer), pointer + "/uri");
    if (size > place.size)
        fail_at(pointer + "/byteLength", fmt::format("at most the {} bytes that are there", place.size),
                std::to_string(size));
    return {Place::State::there, place.offset, size};
}

std::vector<Place> place_buffers(Growing& out, const json& buffers) {
    const std::size_t bin_size = out.binary.size();
    std::vector<Place> places;
    for (std::size_t i = 0; i < buffers.size(); ++i)
        places.push_back(
            place_buffer(out, buffers[i], fmt::format("/buffers/{}", i), i == 0 && bin_size > 0, bin_size));
    return places;
}

// Makes a view (or what its extension says) count from the beginning of the binary.
void move_view(json& view, const std::vector<Place>& places, const std::string& pointer) {
    const Place& place = places[whole_member(view, "buffer", pointer)];
    const std::uint64_t offset = whole_member(view, "byteOffset", pointer, 0);
    const std::uint64_t size = whole_member(view, "byteLength", pointer);
    if (place.state == Place::State::absent)
        fail_at(pointer + "/buffer", "a buffer with bytes", "one without uri and BIN chunk");
    if (size == 0) fail_at(pointer + "/byteLength", "at least 1", "0");
    const bool there = place.state == Place::State::there;
    if (there && offset + size > place.size)
        fail_at(pointer, fmt::format("an end at most at byte {} of its buffer", place.size),
                fmt::format("byte {}", offset + size));
    view["buffer"] = 0;
    view["byteOffset"] = there ? place.offset + offset : 0;
}

void move_views(json& views, const std::vector<Place>& places) {
    for (std::size_t i = 0; i < views.size(); ++i) {
        json& view = views[i];
        const std::string pointer = fmt::format("/bufferViews/{}", i);
        const bool compressed = object_member(view, "extensions", pointer).contains(meshopt);
        const Place& place = places[whole_member(view, "buffer", pointer)];
        if (place.state == Place::State::fallback && !compressed)
            fail_at(pointer, std::string("an extension ") + meshopt, "none");
        move_view(view, places, pointer);
        if (compressed) move_view(view["extensions"][meshopt], places, pointer + "/extensions/" + meshopt);
    }
}

// A picture with a uri becomes a buffer view. What is no picture is kept all the same: it does no harm to a mesh.
void take_picture(Growing& out, json& root, json& image, const std::string& pointer) {
    const Place place = place_uri(out, text_member(image, "uri", pointer), pointer + "/uri");
    if (place.size == 0) fail_at(pointer + "/uri", "a picture", "no bytes");
    const std::string_view type = picture_type(Bytes(out.binary).subspan(place.offset, place.size));
    image.erase("uri");
    image["bufferView"] = element_count(root, "bufferViews");
    if (!type.empty()) image["mimeType"] = type;
    if (!image.contains("mimeType")) image["mimeType"] = "application/octet-stream";
    root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", place.offset}, {"byteLength", place.size}});
}

std::string picture_name(const json& image, std::size_t number) {
    const std::string name = text_member(image, "name", fmt::format("/images/{}", number));
    return name.empty() ? fmt::format("picture {}", number) : fmt::format("picture {} {}", number, shown(name));
}

// A head does without a picture that is not there. Which one, and why, is said.
void take_pictures(Growing& out, GltfDocument& document) {
    json& root = document.json;
    const std::size_t images = element_count(root, "images");
    std::set<std::size_t> missing;
    for (std::size_t i = 0; i < images; ++i) {
        if (!root["images"][i].contains("uri")) continue;
        try {
            take_picture(out, root, root["images"][i], fmt::format("/images/{}", i));
        } catch (const Error& error) {
            document.left_out.push_back(fmt::format("{}: {}", picture_name(root["images"][i], i), error.what()));
            missing.insert(i);
        }
    }
    drop_pictures(root, missing);
}

GltfDocument parsed(Bytes bytes) {
    const bool binary = as_text(bytes).substr(0, 4) == "glTF";
    return binary ? parse_glb(bytes) : GltfDocument{parse_gltf_json(bytes), {}, {}};
}

}  // namespace

void check_view(const GltfDocument& document, std::size_t view) {
    const std::string pointer = fmt::format("/bufferViews/{}", view);
    const json& views = array_member(document.json, "bufferViews", "");
    if (view >= views.size()) fail_at(pointer, fmt::format("one of {} buffer views", views.size()), "none");
    const std::uint64_t end =
        whole_member(views[view], "byteOffset", pointer, 0) + whole_member(views[view], "byteLength", pointer);
    if (end > document.binary.size())
        fail_at(pointer, fmt::format("an end at most at byte {}", document.binary.size()), fmt::format("byte {}", end));
}

GltfDocument load_gltf(std::span<const std::byte> bytes, const Fetch& fetch) {
    GltfDocument document = parsed(bytes);
    json& root = document.json;
    check_asset(root);
    check_arrays(root);
    check_extensions(root);
    check_references(root);
    Growing out{document.binary, fetch, {}};
    const std::vector<Place> places = place_buffers(out, array_member(root, "buffers", ""));
    if (root.contains("bufferViews")) move_views(root["bufferViews"], places);
    take_pictures(out, document);
    root.erase("buffers");
    if (!document.binary.empty()) root["buffers"] = json::array({{{"byteLength", document.binary.size()}}});
    return document;
}

}  // namespace mien
