// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Assimp's reader of FBX was not made for hostile files: its log is full of bounds that were missing. So it works in a
// process of its own with little memory and time, and what comes back is a GLB, which is checked like any other.

#include "mien/io/fbx.hpp"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <string>
#include <string_view>

#include "io/fbx_scene.hpp"
#include "io/isolated.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

// As large as the densest file becomes while it is read, and as long as the slowest takes, several times over.
IsolatedLimits limits_of(std::size_t bytes) {
    constexpr std::uint64_t least_memory = std::uint64_t{256} << 20U, memory_per_byte = 64;
    constexpr std::size_t least_seconds = 4, bytes_per_second = std::size_t{1} << 18U;
    return {least_memory + memory_per_byte * bytes,
            static_cast<std::uint32_t>(least_seconds + bytes / bytes_per_second)};
}

// What Assimp says may hold pieces of the file.
std::string printable(std::string_view text) {
    constexpr std::size_t most = 200;
    std::string result(text.substr(0, most));
    for (char& c : result)
        if (c < ' ' || c > '~') c = '?';
    return result;
}

std::vector<std::byte> convert(std::span<const std::byte> bytes) {
    Assimp::Importer importer;
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_TEXTURES, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_CAMERAS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_LIGHTS, false);
    const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), aiProcess_Triangulate, "fbx");
    if (scene == nullptr) throw Error("fbx: Assimp cannot read it: " + printable(importer.GetErrorString()));
    return format_glb(document_of(*scene));
}

}  // namespace

std::vector<std::byte> convert_fbx(std::span<const std::byte> bytes) {
    return run_isolated("fbx", limits_of(bytes.size()), [&] { return convert(bytes); });
}

}  // namespace mien
