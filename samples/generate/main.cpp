// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Writes the sample heads and the sample performance into a folder: mien_samples FOLDER

#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

#include "performance.hpp"
#include "write_surfaces.hpp"

namespace {

bool write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    return file.flush().good();
}

}  // namespace

int main(int argc, char** argv) {
    using namespace mien::samples;
    if (argc != 2) {
        fmt::print(stderr, "usage: mien_samples FOLDER\n");
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    bool written = true;
    for (const Character& character : cast()) {
        const Head head = make_head(character);
        written = written && write(folder / (head.name + ".glb"), format_glb(head)) &&
                  write(folder / (head.name + ".points.json"), format_points_by_mesh(head));
        if (head.name != "head") continue;
        const Performance performance = perform(head);
        written = written && write(folder / "head.obj", format_obj(head.parts)) &&
                  write(folder / "head-obj.points.json", format_points_by_vertex(head)) &&
                  write(folder / "take.trc", format_trc_take(performance.take)) &&
                  write(folder / "markers.csv", format_names(performance));
    }
    if (!written) fmt::print(stderr, "mien_samples: cannot write into {}\n", folder.string());
    return written ? 0 : 3;
}
