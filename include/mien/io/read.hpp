// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mien/face.hpp"
#include "mien/fap_interpolation.hpp"
#include "mien/io/fba.hpp"
#include "mien/io/fdp_text.hpp"
#include "mien/io/gltf.hpp"
#include "mien/io/point_cache.hpp"
#include "mien/io/points.hpp"
#include "mien/io/sequence.hpp"
#include "mien/measured_point.hpp"
#include "mien/mesh_sequence.hpp"
#include "mien/scene.hpp"
#include "mien/take.hpp"

namespace mien {

/// Reads a head by its extension: .glb .gltf .fbx .obj .off .ply. Throws Error whose sentence starts with the file's
/// name; Kind::access when the file cannot be read. A mesh whose faces all lie on a point or a line is refused. A .gltf
/// may name files in its own folder and below, nothing else; a picture that is not there is named in `Mesh::left_out`.
Mesh read_mesh(const std::filesystem::path& path);

/// Reads what a file shows by its extension, as `read_mesh` does: `parse_scene` for .glb and .gltf, `scene_of` for the
/// others.
Scene read_scene(const std::filesystem::path& path);

/// Reads an animated head by its extension: .glb .gltf .fbx, .mdd and .pc2 with a head, or a folder of OBJ or PLY
/// files, one a row in the natural order of their names ("frame_9" before "frame_10"). What is read from glTF and FBX
/// is worked out when a row is asked for, positions of caches and folders are kept in memory.
///
/// Throws Error whose sentence starts with the file's name: as the parsers of mien/io/sequence.hpp do, and for a folder
/// whose files differ in their vertices or faces.
MeshSequence read_sequence(const std::filesystem::path& path, const SequenceOptions& options = {});

/// What a file of animated heads holds (.glb .gltf .fbx), one entry per animation; none where nothing moves.
std::vector<Animation> read_animations(const std::filesystem::path& path);

/// What a point cache holds (.mdd .pc2).
PointCacheContent read_cache_content(const std::filesystem::path& path);

/// Reads a take by its extension: .trc .csv .c3d.
Take read_take(const std::filesystem::path& path);

/// Reads face animation parameters by their extension: .fap (text) .fba (bitstream).
DecodedFaps read_faps(const std::filesystem::path& path);

/// Reads an interpolation table (.json).
FapInterpolation read_fit(const std::filesystem::path& path);

/// Reads feature points for a mesh.
PointsFile read_points(const std::filesystem::path& path, const Mesh& mesh);

/// Reads measured feature points (.json).
std::vector<MeasuredPoint> read_measured_points(const std::filesystem::path& path);

/// Reads a head with its feature points.
Face read_face(const std::filesystem::path& head, const std::filesystem::path& points);

/// Reads a marker map for `rename_points`: .csv or .json.
std::vector<Rename> read_marker_map(const std::filesystem::path& path);

/// Reads a face definition by its extension: .fat .bt .fdp .fapu (BIFS text) .json. The options are for BIFS text.
Fdp read_fdp(const std::filesystem::path& path, const FdpTextOptions& options = {});

/// Reads a rig file written by mien.
RigFile read_rig(const std::filesystem::path& path);

}  // namespace mien
