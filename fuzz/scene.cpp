// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/scene.hpp"

#include "fuzz.hpp"
#include "io/promise.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mien;
    const auto no_file = [](std::string_view) -> std::vector<std::byte> { throw Error("no file here"); };
    return fuzz::run(
        data, size, [&](std::span<const std::byte> bytes) { return parse_scene(bytes, no_file); },
        [](const Scene& scene) {
            fuzz::expect(hostile::keeps_promise(scene), "indices and numbers");
            fuzz::expect(pose_at(scene, duration(scene) / 2).worlds.size() == scene.nodes.size(), "a pose");
        });
}
