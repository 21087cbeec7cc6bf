// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Files by their extension. The extension alone chooses the parser: a guess from the first bytes would be a second way
// that could disagree with the first.

#include "mien/io/read.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <system_error>

#include "io/frame_folder.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"
#include "mien/io/c3d.hpp"
#include "mien/io/fap_text.hpp"
#include "mien/io/fbx.hpp"
#include "mien/io/fdp_json.hpp"
#include "mien/io/fit.hpp"
#include "mien/io/marker_map.hpp"
#include "mien/io/measured_points.hpp"
#include "mien/io/obj.hpp"
#include "mien/io/off.hpp"
#include "mien/io/ply.hpp"
#include "mien/io/scene.hpp"
#include "mien/io/take_csv.hpp"
#include "mien/io/trc.hpp"

namespace mien {

namespace {

namespace fs = std::filesystem;

using Bytes = std::vector<std::byte>;

[[noreturn]] void cannot_read(const fs::path& path, std::string_view why) {
    throw Error(fmt::format("{}: cannot read: {}", path.string(), why), Error::Kind::access);
}

// By chunks and not by a size asked for first, so that pipes can be read as well.
Bytes read_bytes(const fs::path& path) {
    std::error_code unknown;
    if (fs::is_directory(path, unknown)) cannot_read(path, "it is a folder");
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) cannot_read(path, std::generic_category().message(errno));
    constexpr std::size_t chunk = std::size_t{1} << 20;
    Bytes bytes;
    for (std::size_t got = chunk; got == chunk;) {
        const std::size_t size = bytes.size();
        bytes.resize(size + chunk);
        got = std::fread(bytes.data() + size, 1, chunk, file.get());
        bytes.resize(size + got);
    }
    if (std::ferror(file.get()) != 0) cannot_read(path, std::generic_category().message(errno));
    bytes.shrink_to_fit();
    return bytes;
}

// An error of a parser, behind the file's name.
[[noreturn]] void fail_in(const fs::path& path, const Error& error) {
    throw Error(fmt::format("{}: {}", path.string(), error.what()), error.kind());
}

// Reads the file and parses it, with its name before whatever the parser has to say.
template <class Parse>
auto parsed(const fs::path& path, const Parse& parse) {
    const Bytes bytes = read_bytes(path);
    try {
        return parse(std::span<const std::byte>(bytes));
    } catch (const Error& error) {
        fail_in(path, error);
    }
}

bool has_extension(const fs::path& path, std::string_view extension) {
    return equal_but_case(path.extension().string(), extension);
}

[[noreturn]] void unknown_extension(const fs::path& path, std::string_view known) {
    throw Error(fmt::format("{}: expected a file that ends in {}, found {}", path.string(), known,
                            shown(path.extension().string())));
}

// Twice the area of a polygon as a vector, and the square of how far it reaches from its first corner.
struct Extent {
    Vec3 area;
    double reach = 0;
};

Extent extent(const Mesh& mesh, std::size_t f) {
    const std::span<const std::uint32_t> corners = face(mesh, f);
    const Vec3 first = to_double(mesh.positions[corners[0]]);
    Extent result;
    Vec3 before;
    for (const std::uint32_t corner : corners) {
        const Vec3 here = to_double(mesh.positions[corner]) - first;
        result.area += cross(before, here);
        result.reach = std::max(result.reach, dot(here, here));
        before = here;
    }
    return result;
}

// A head whose every face is a point or a line has no surface to spread motion over. Single flat faces are common and
// do no harm, and fewer faces than close round anything are a stub beside curves or points, read as it is. Rounding of
// single precision alone makes a line 1e-7 of its length wide.
void refuse_flat(const Mesh& mesh) {
    constexpr double thin = 1e-6;
    constexpr std::size_t fewest_of_a_body = 4;
    for (std::size_t f = 0; f < face_count(mesh); ++f)
        if (const Extent e = extent(mesh, f); length(e.area) > thin * e.reach) return;
    if (face_count(mesh) >= fewest_of_a_body)
        throw Error(fmt::format("expected a surface, found no area in any of {} faces: all lie on a point or a line",
                                face_count(mesh)));
}

// Whether `path` lies inside `folder`; both are real paths, links followed.
bool is_inside(const fs::path& path, const fs::path& folder) {
    const fs::path relative = path.lexically_relative(folder);
    return !relative.empty() && *relative.begin() != "..";
}

// The files beside a .gltf. The uri comes from a stranger: what it leads to, links followed, has to lie in the folder.
Bytes fetch_beside(const fs::path& gltf, std::string_view uri) {
    std::error_code error;
    const fs::path folder = fs::canonical(gltf.has_parent_path() ? gltf.parent_path() : fs::path("."), error);
    const fs::path target = error ? fs::path() : fs::canonical(folder / fs::path(uri), error);
    if (error) throw Error(fmt::format("uri {}: expected a file beside the .gltf, found none", shown(uri)));
    if (!is_inside(target, folder) || !fs::is_regular_file(target))
        throw Error(
            fmt::format("uri {}: expected a file inside the folder of the .gltf, found another place", shown(uri)));
    return read_bytes(target);
}

bool is_gltf(const fs::path& path) {
    return has_extension(path, ".glb") || has_extension(path, ".gltf");
}

bool is_fbx(const fs::path& path) {
    return has_extension(path, ".fbx");
}

// For documents that hold everything themselves.
Bytes no_fetch(std::string_view uri) {
    throw Error(fmt::format("uri {}: expected nothing outside of the file", shown(uri)));
}

Fetch beside(const fs::path& gltf) {
    return [gltf](std::string_view uri) { return fetch_beside(gltf, uri); };
}

// The parser of a mesh by extension; an unknown one is refused before the file is opened.
using ParseMesh = std::function<Mesh(std::span<const std::byte>)>;
ParseMesh mesh_parser(const fs::path& path) {
    if (has_extension(path, ".obj")) return parse_obj;
    if (has_extension(path, ".off")) return parse_off;
    if (has_extension(path, ".ply")) return parse_ply;
    if (is_fbx(path)) return [](std::span<const std::byte> bytes) { return parse_gltf(convert_fbx(bytes), no_fetch); };
    if (!is_gltf(path)) unknown_extension(path, ".glb, .gltf, .fbx, .obj, .off or .ply");
    return [fetch = beside(path)](std::span<const std::byte> bytes) { return parse_gltf(bytes, fetch); };
}

// Rows are worked out later, and an error of theirs is the file's as well.
MeshSequence named(const fs::path& path, MeshSequence sequence) {
    sequence.positions = [path, row_of = std::move(sequence.positions)](std::size_t row, std::span<Vec3f> positions) {
        try {
            row_of(row, positions);
        } catch (const Error& error) {
            fail_in(path, error);
        }
    };
    return sequence;
}

using ParseCache = MeshSequence (*)(Bytes, Mesh, double);
MeshSequence read_cache(const fs::path& path, const SequenceOptions& options, ParseCache parse) {
    if (options.head.empty())
        throw Error(
            fmt::format("{}: it holds positions alone; expected the head they belong to, found none", path.string()));
    Mesh head = read_mesh(options.head);
    Bytes bytes = read_bytes(path);
    try {
        return parse(std::move(bytes), std::move(head), options.rate);
    } catch (const Error& error) {
        fail_in(path, error);
    }
}

}  // namespace

Mesh read_mesh(const fs::path& path) {
    const ParseMesh parse = mesh_parser(path);
    return parsed(path, [&](std::span<const std::byte> bytes) {
        Mesh mesh = parse(bytes);
        refuse_flat(mesh);
        return mesh;
    });
}

Scene read_scene(const fs::path& path) {
    const ParseMesh parse = mesh_parser(path);
    return parsed(path, [&](std::span<const std::byte> bytes) {
        return is_gltf(path) ? parse_scene(bytes, beside(path)) : scene_of(parse(bytes));
    });
}

MeshSequence read_sequence(const fs::path& path, const SequenceOptions& options) {
    std::error_code unknown;
    if (fs::is_directory(path, unknown)) return read_frames(path, options.rate);
    if (has_extension(path, ".mdd")) return read_cache(path, options, parse_mdd);
    if (has_extension(path, ".pc2")) return read_cache(path, options, parse_pc2);
    if (!is_gltf(path) && !is_fbx(path)) unknown_extension(path, ".glb, .gltf, .fbx, .mdd or .pc2, or a folder");
    return named(path, parsed(path, [&](std::span<const std::byte> bytes) {
                     return is_fbx(path) ? parse_gltf_sequence(convert_fbx(bytes), no_fetch, options)
                                         : parse_gltf_sequence(bytes, beside(path), options);
                 }));
}

std::vector<Animation> read_animations(const fs::path& path) {
    if (!is_gltf(path) && !is_fbx(path)) unknown_extension(path, ".glb, .gltf or .fbx");
    return parsed(path, [&](std::span<const std::byte> bytes) {
        return is_fbx(path) ? parse_gltf_animations(convert_fbx(bytes), no_fetch)
                            : parse_gltf_animations(bytes, beside(path));
    });
}

PointCacheContent read_cache_content(const fs::path& path) {
    const bool is_mdd = has_extension(path, ".mdd");
    if (!is_mdd && !has_extension(path, ".pc2")) unknown_extension(path, ".mdd or .pc2");
    return parsed(path, [&](std::span<const std::byte> bytes) {
        return is_mdd ? check_mdd({bytes.begin(), bytes.end()}) : check_pc2({bytes.begin(), bytes.end()});
    });
}

Take read_take(const fs::path& path) {
    if (has_extension(path, ".trc")) return parsed(path, parse_trc);
    if (has_extension(path, ".csv")) return parsed(path, parse_take_csv);
    if (has_extension(path, ".c3d")) return parsed(path, parse_c3d);
    unknown_extension(path, ".trc, .csv or .c3d");
}

DecodedFaps read_faps(const fs::path& path) {
    if (has_extension(path, ".fba")) return parsed(path, parse_fba);
    if (!has_extension(path, ".fap")) unknown_extension(path, ".fap or .fba");
    return parsed(path, [](std::span<const std::byte> bytes) { return DecodedFaps{parse_fap_text(bytes), {}}; });
}

FapInterpolation read_fit(const fs::path& path) {
    return parsed(path, parse_fit);
}

PointsFile read_points(const fs::path& path, const Mesh& mesh) {
    return parsed(path, [&](std::span<const std::byte> bytes) { return parse_points(bytes, mesh); });
}

std::vector<MeasuredPoint> read_measured_points(const fs::path& path) {
    return parsed(path, parse_measured_points);
}

Face read_face(const fs::path& head, const fs::path& points) {
    Mesh mesh = read_mesh(head);
    std::vector<FeaturePoint> on_mesh = read_points(points, mesh).points;
    return {std::move(mesh), std::move(on_mesh)};
}

std::vector<Rename> read_marker_map(const fs::path& path) {
    if (!has_extension(path, ".csv") && !has_extension(path, ".json")) unknown_extension(path, ".csv or .json");
    return parsed(path, parse_marker_map);
}

Fdp read_fdp(const fs::path& path, const FdpTextOptions& options) {
    if (has_extension(path, ".json")) return parsed(path, parse_fdp_json);
    for (const std::string_view extension : {".fat", ".bt", ".fdp", ".fapu"})
        if (has_extension(path, extension))
            return parsed(path, [&](std::span<const std::byte> bytes) { return parse_fdp_text(bytes, options); });
    unknown_extension(path, ".fat, .bt, .fdp, .fapu or .json");
}

RigFile read_rig(const fs::path& path) {
    if (!has_extension(path, ".glb")) unknown_extension(path, ".glb");
    return parsed(path, parse_rig);
}

}  // namespace mien
