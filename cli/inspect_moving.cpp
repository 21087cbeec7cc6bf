// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "inspect_moving.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>

#include "mien/io/read.hpp"

namespace mien::cli {

namespace {

std::string small_extension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

Report about(const Animation& animation) {
    Report report = {{"name", animation.name},
                     {"starts_at", animation.start},
                     {"seconds", animation.seconds},
                     {"rows", animation.rows},
                     {"rows_per_second", animation.rate}};
    if (!animation.nodes.empty()) report["moving_nodes"] = animation.nodes;
    if (!animation.morphs.empty()) report["moving_morph_targets"] = animation.morphs;
    if (!animation.skins.empty()) report["moving_skins"] = animation.skins;
    return report;
}

}  // namespace

bool is_point_cache(const std::filesystem::path& file) {
    return small_extension(file) == ".mdd" || small_extension(file) == ".pc2";
}

void inspect_point_cache(const std::filesystem::path& file, Report& report) {
    const PointCacheContent content = read_cache_content(file);
    report["kind"] = "point cache";
    report["rows"] = content.rows;
    report["vertices"] = content.vertices;
    if (content.times.size() > 1) {
        report["seconds"] = content.times.back();
        report["rows_per_second"] = static_cast<double>(content.rows - 1) / content.times.back();
    }
}

Mesh inspect_frames(const std::filesystem::path& folder, Report& report) {
    SequenceOptions options;
    options.rate = 1;
    MeshSequence sequence = read_sequence(folder, options);
    report["rows"] = sequence.times.size();
    return std::move(sequence.mesh);
}

void inspect_animations(const std::filesystem::path& file, Report& report) {
    const std::string extension = small_extension(file);
    if (extension != ".glb" && extension != ".gltf" && extension != ".fbx") return;
    for (const Animation& animation : read_animations(file)) report["animations"].push_back(about(animation));
}

}  // namespace mien::cli
