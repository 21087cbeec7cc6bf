// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Pictures of glTF 2.0 (specification, 3.8): PNG and JPEG by their first bytes, whatever the document says they are.

#include "io/gltf_pictures.hpp"

#include <fmt/format.h>
#include <span>

#include "io/gltf_document.hpp"
#include "io/gltf_json.hpp"
#include "io/gltf_uri.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"
#include "mien/io/jpeg.hpp"
#include "mien/io/png.hpp"

namespace mien {

namespace {

using nlohmann::json;

// Many pictures may lie in the same few bytes: what is unpacked in all may grow with the bytes that are there.
constexpr std::uint64_t free_pixels = std::uint64_t{1} << 26;
constexpr std::uint64_t pixels_per_byte = 16;

Picture decoded(std::span<const std::byte> bytes) {
    const std::string_view type = picture_type(bytes);
    if (type == "image/png") return parse_png(bytes);
    if (type == "image/jpeg") return parse_jpeg(bytes);
    throw Error(fmt::format("expected PNG or JPEG, found {}", type.empty() ? "something else" : type));
}

Picture read_picture(Pictures& pictures, std::size_t image) {
    const GltfDocument& document = pictures.document;
    const std::string pointer = fmt::format("/images/{}", image);
    const std::size_t view = whole_member(document.json["images"][image], "bufferView", pointer);
    check_view(document, view);
    const json& place = document.json["bufferViews"][view];
    const std::string view_pointer = fmt::format("/bufferViews/{}", view);
    if (pictures.pixels == 0) throw Error("expected fewer pixels in all, found no room for more");
    Picture picture = decoded(std::span(document.binary)
                                  .subspan(whole_member(place, "byteOffset", view_pointer, 0),
                                           whole_member(place, "byteLength", view_pointer)));
    const std::uint64_t pixels = std::uint64_t{picture.width} * picture.height;
    const std::uint64_t left = pictures.pixels;
    // What does not fit closes the door, so that no later picture is unpacked in vain.
    pictures.pixels = pixels > left ? 0 : left - pixels;
    if (pixels > left) throw Error(fmt::format("expected at most {} more pixels in all, found {}", left, pixels));
    return picture;
}

std::string name_of(const json& image, std::size_t number) {
    const std::string name = text_member(image, "name", fmt::format("/images/{}", number));
    return name.empty() ? fmt::format("picture {}", number) : fmt::format("picture {} {}", number, shown(name));
}

}  // namespace

Pictures::Pictures(const GltfDocument& from)
    : document(from), pixels(free_pixels + pixels_per_byte * from.binary.size()) {}

std::optional<std::uint32_t> picture_of(Pictures& pictures, std::size_t texture) {
    const json& root = pictures.document.json;
    const auto image = find_whole(root["textures"][texture], "source", fmt::format("/textures/{}", texture));
    if (!image) {
        pictures.left_out.push_back(fmt::format("texture {}: it has no picture as PNG or JPEG", texture));
        return std::nullopt;
    }
    const auto [known, is_new] = pictures.numbers.try_emplace(*image);
    if (!is_new) return known->second;
    try {
        pictures.read.push_back(read_picture(pictures, *image));
        known->second = static_cast<std::uint32_t>(pictures.read.size() - 1);
    } catch (const Error& error) {
        pictures.left_out.push_back(fmt::format("{}: {}", name_of(root["images"][*image], *image), error.what()));
    }
    return known->second;
}

}  // namespace mien
