// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/gltf.hpp"

#include "fuzz.hpp"
#include "glb_mutator.hpp"
#include "io/promise.hpp"

namespace {

std::vector<std::byte> no_file(std::string_view) {
    throw mien::Error("no file here");
}

// What the head's document becomes on the way out; nothing where it cannot be written.
std::vector<std::byte> written(const mien::Mesh& mesh) {
    try {
        return format_glb(mesh, mien::MorphTrack{});
    } catch (const mien::Error&) {
        return {};
    }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mien;
    const auto parse = [](std::span<const std::byte> bytes) { return parse_gltf(bytes, no_file); };
    return fuzz::run(data, size, parse, [&](const Mesh& mesh) {
        fuzz::expect(hostile::keeps_promise(mesh), "indices and numbers");
        const std::vector<std::byte> bytes = written(mesh);
        if (!bytes.empty()) fuzz::expect(parse(bytes).positions == mesh.positions, "what is written reads back equal");
    });
}
