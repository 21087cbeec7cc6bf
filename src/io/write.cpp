// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Atomic writing: everything goes to a temporary name beside the target, is forced to the disk, and is renamed at the
// end (io/temporary.hpp).

#include "mien/io/write.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <string>
#include <system_error>

#include "io/temporary.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"
#include "mien/io/fdp_json.hpp"
#include "mien/io/fdp_text.hpp"
#include "mien/io/point_cache.hpp"
#include "mien/io/take_csv.hpp"
#include "mien/io/trc.hpp"

namespace mien {

namespace {

namespace fs = std::filesystem;

bool is_folder(const fs::path& path) {
    std::error_code error;
    return fs::is_directory(path, error);
}

// Lets `fill` write a new file at `path`; errors name the target that it is for.
template <class Fill>
void fill_file(const fs::path& path, const fs::path& target, const Fill& fill) {
    errno = 0;
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    if (!out) cannot_write(target, errno);
    fill(out);
    out.close();
    if (!out) cannot_write(target, errno != 0 ? errno : EIO);
    synchronize(path, target);
}

template <class Fill>
void write_by(const fs::path& path, const WriteOptions& options, const Fill& fill) {
    refuse_existing(path, options.overwrite);
    if (is_folder(path)) cannot_write(path, "it is a folder");
    const Temporary temporary(path, options.overwrite);
    fill_file(temporary.path(), path, fill);
    temporary.move_to_target();
}

bool has_extension(const fs::path& path, std::string_view extension) {
    return equal_but_case(path.extension().string(), extension);
}

[[noreturn]] void unknown_extension(const fs::path& path, std::string_view known) {
    throw Error(fmt::format("{}: expected an output that ends in {}, found {}", path.string(), known,
                            shown(path.extension().string())));
}

// The sequence, telling how far it has come as its rows are asked for.
MeshSequence watched(const MeshSequence& sequence, const WriteOptions& options) {
    MeshSequence result = sequence;
    if (!options.progress) return result;
    result.positions = [&sequence, &options](std::size_t row, std::span<Vec3f> positions) {
        sequence.positions(row, positions);
        options.progress(row + 1, sequence.times.size());
    };
    return result;
}

// Numbered from 1 with equal width, so that listings are in order.
std::string frame_name(std::size_t row, std::string_view extension) {
    return fmt::format("frame_{:06}{}", row + 1, extension);
}

bool is_frame(const fs::directory_entry& entry, std::string_view back) {
    const std::string name = entry.path().filename().string();
    constexpr std::string_view front = "frame_";
    if (name.size() < front.size() + 6 + back.size() || !name.starts_with(front) || !name.ends_with(back)) return false;
    std::error_code error;
    return name.find_first_not_of("0123456789", front.size()) == name.size() - back.size() &&
           fs::is_regular_file(entry.symlink_status(error));
}

// Only a folder that holds nothing but its own kind of files is replaced: a mistyped path must not cost a home
// directory.
template <class IsOurs>
void refuse_other_folder(const fs::path& path, const std::string& kind, const IsOurs& is_ours) {
    if (!is_there(path)) return;
    if (!is_folder(path)) cannot_write(path, fmt::format("it is a file; expected a folder of {} or nothing", kind));
    std::error_code error;
    for (auto entry = fs::directory_iterator(path, error); entry != fs::directory_iterator(); entry.increment(error))
        if (!is_ours(*entry)) cannot_write(path, fmt::format("the folder holds other files than {}", kind));
    if (error) cannot_write(path, error.message());
}

void create_folder(const fs::path& folder, const fs::path& target) {
    std::error_code error;
    if (!fs::create_directory(folder, error)) cannot_write(target, error ? error.value() : EEXIST);
}

void fill_folder(const fs::path& folder, const fs::path& target, const Frames& frames) {
    create_folder(folder, target);
    for (std::size_t row = 0; row < frames.count; ++row)
        fill_file(folder / frame_name(row, frames.extension), target,
                  [&](std::ostream& out) { frames.write(row, out); });
    synchronize(folder, target);
}

void fill_folder(const fs::path& folder, const fs::path& target, std::span<const NamedFile> files) {
    create_folder(folder, target);
    for (const NamedFile& file : files)
        fill_file(folder / file.name, target, [&](std::ostream& out) { out << file.bytes; });
    synchronize(folder, target);
}

// The new folder in the place of the old one, which goes when that is done.
template <class Files>
void replace_folder(const fs::path& path, const Files& files, const WriteOptions& options) {
    const Temporary temporary(path, options.overwrite);
    fill_folder(temporary.path(), path, files);
    if (!is_there(path)) return temporary.move_to_target();
    fs::path aside = temporary.path();
    aside += "-old";
    if (std::rename(path.c_str(), aside.c_str()) != 0) cannot_write(path, errno);
    temporary.move_to_target();
    std::error_code ignored;
    fs::remove_all(aside, ignored);
}

Frames obj_frames(const MeshSequence& sequence, std::vector<Vec3f>& positions) {
    positions.resize(vertex_count(sequence.mesh));
    return {".obj", sequence.times.size(), [&](std::size_t row, std::ostream& out) {
                sequence.positions(row, positions);
                format_obj(sequence.mesh, positions, out);
            }};
}

}  // namespace

void write_file(const fs::path& path, std::span<const std::byte> bytes, const WriteOptions& options) {
    write_by(path, options, [&](std::ostream& out) {
        out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    });
}

// An old folder of frames steps aside and is removed at the end; a folder cannot be renamed over a full one.
void write_folder(const Frames& frames, const fs::path& path, const WriteOptions& options) {
    refuse_existing(path, options.overwrite);
    refuse_other_folder(path, fmt::format("{} and so on", frame_name(0, frames.extension)),
                        [&](const fs::directory_entry& entry) { return is_frame(entry, frames.extension); });
    replace_folder(path, frames, options);
}

void write_folder(std::span<const NamedFile> files, const fs::path& path, const WriteOptions& options) {
    refuse_existing(path, options.overwrite);
    std::string kind;
    for (const NamedFile& file : files) kind += (kind.empty() ? "" : ", ") + file.name;
    refuse_other_folder(path, kind, [&](const fs::directory_entry& entry) {
        std::error_code error;
        return fs::is_regular_file(entry.symlink_status(error)) &&
               std::any_of(files.begin(), files.end(),
                           [&](const NamedFile& file) { return entry.path().filename() == file.name; });
    });
    replace_folder(path, files, options);
}

void write(const Take& take, const fs::path& path, const WriteOptions& options) {
    if (has_extension(path, ".csv")) return write_file(path, as_bytes(format_take_csv(take)), options);
    if (has_extension(path, ".trc")) return write_file(path, as_bytes(format_trc(take)), options);
    unknown_extension(path, ".csv or .trc");
}

void write(const Fdp& fdp, const fs::path& path, const WriteOptions& options) {
    if (has_extension(path, ".json")) return write_file(path, as_bytes(format_fdp_json(fdp)), options);
    if (has_extension(path, ".fat") || has_extension(path, ".bt"))
        return write_file(path, as_bytes(format_fdp_text(fdp)), options);
    const bool points = has_extension(path, ".fdp");
    if (!points && !has_extension(path, ".fapu")) unknown_extension(path, ".fat, .bt, .fdp, .fapu or .json");
    Fdp part;
    part.fapu = fdp.fapu;
    part.mesh.unit = fdp.mesh.unit;
    if (points) part.points = fdp.points;
    write_file(path, as_bytes(format_fdp_text(part)), options);
}

void write(const MeshSequence& sequence, const fs::path& path, const WriteOptions& options) {
    const MeshSequence rows = watched(sequence, options);
    if (has_extension(path, ".mdd")) return write_by(path, options, [&](std::ostream& out) { format_mdd(rows, out); });
    if (has_extension(path, ".pc2")) return write_by(path, options, [&](std::ostream& out) { format_pc2(rows, out); });
    std::vector<Vec3f> positions;
    if (path.extension().empty()) return write_folder(obj_frames(rows, positions), path, options);
    unknown_extension(path, ".mdd, .pc2 or, for a folder of .obj, in no extension");
}

}  // namespace mien
