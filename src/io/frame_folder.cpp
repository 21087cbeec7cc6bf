// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/frame_folder.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "io/text.hpp"

#include "mien/error.hpp"
#include "mien/io/read.hpp"

namespace mien {

namespace {

namespace fs = std::filesystem;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// Takes what comes next off the text: a run of digits without the zeros before it, or one other character.
std::string_view take_next(std::string_view& text) {
    std::size_t size = 1;
    if (is_digit(text[0])) {
        while (text.size() > 1 && text[0] == '0' && is_digit(text[1])) text.remove_prefix(1);
        while (size < text.size() && is_digit(text[size])) ++size;
    }
    const std::string_view next = text.substr(0, size);
    text.remove_prefix(size);
    return next;
}

bool is_frame(const fs::path& path) {
    const std::string extension = path.extension().string();
    return equal_but_case(extension, ".obj") || equal_but_case(extension, ".ply");
}

std::vector<fs::path> frame_files(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
        if (is_frame(at->path()) && at->is_regular_file()) files.push_back(at->path());
    if (error) throw Error(fmt::format("{}: cannot read: {}", folder.string(), error.message()), Error::Kind::access);
    std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
        return is_before_by_number(a.filename().string(), b.filename().string());
    });
    return files;
}

[[noreturn]] void fail(const fs::path& file, const std::string& expected, const std::string& found) {
    throw Error(fmt::format("{}: expected {}, found {}", file.string(), expected, found));
}

// Faces as they are in the first file: corner by corner, so that every vertex is the same in all rows.
void check_topology(const fs::path& file, const Mesh& mesh, const Mesh& first, const std::string& name) {
    const auto compare = [&](std::size_t expected, std::size_t found, const char* what) {
        if (expected != found) fail(file, fmt::format("{} {} as in {}", expected, what, name), std::to_string(found));
    };
    compare(vertex_count(first), vertex_count(mesh), "vertices");
    compare(face_count(first), face_count(mesh), "faces");
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        const auto ours = face(mesh, f), theirs = face(first, f);
        if (!std::equal(ours.begin(), ours.end(), theirs.begin(), theirs.end()))
            fail(file, fmt::format("face {} to have the corners it has in {}", f, name), "others");
    }
}

}  // namespace

bool is_before_by_number(std::string_view a, std::string_view b) {
    const std::string_view whole_a = a, whole_b = b;
    while (!a.empty() && !b.empty()) {
        const bool numbers = is_digit(a[0]) && is_digit(b[0]);
        const std::string_view x = take_next(a), y = take_next(b);
        if (numbers && x.size() != y.size()) return x.size() < y.size();
        if (x != y) return x < y;
    }
    return std::make_tuple(a.size(), whole_a) < std::make_tuple(b.size(), whole_b);
}

MeshSequence read_frames(const fs::path& folder, double rate) {
    const std::vector<fs::path> files = frame_files(folder);
    if (files.empty()) fail(folder, "OBJ or PLY files in the folder, one a row", "none");
    if (!std::isfinite(rate) || rate <= 0) fail(folder, "the rows per second to be given", fmt::format("{}", rate));
    MeshSequence sequence{read_mesh(files[0]), {}, {}};
    std::vector<std::vector<Vec3f>> rows{sequence.mesh.positions};
    for (std::size_t row = 1; row < files.size(); ++row) {
        Mesh mesh = read_mesh(files[row]);
        check_topology(files[row], mesh, sequence.mesh, files[0].filename().string());
        rows.push_back(std::move(mesh.positions));
    }
    for (std::size_t row = 0; row < rows.size(); ++row) sequence.times.push_back(static_cast<double>(row) / rate);
    sequence.positions = [shared = std::make_shared<const std::vector<std::vector<Vec3f>>>(std::move(rows))](
                             std::size_t row, std::span<Vec3f> positions) {
        std::copy((*shared)[row].begin(), (*shared)[row].end(), positions.begin());
    };
    return sequence;
}

}  // namespace mien
