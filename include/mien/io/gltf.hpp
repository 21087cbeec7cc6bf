// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "mien/mesh.hpp"
#include "mien/mesh_sequence.hpp"
#include "mien/rig.hpp"
#include "mien/take.hpp"

namespace mien {

/// Fetches a file that a .gltf names by a relative uri; throws Error when there is none.
using Fetch = std::function<std::vector<std::byte>(std::string_view uri)>;

/// glTF 2.0, text or binary: all meshes and primitives with node transforms, sparse accessors, interleaving,
/// KHR_mesh_quantization, EXT_meshopt_compression, KHR_draco_mesh_compression, morph targets with their names; skins in
/// their rest pose. A mesh that several nodes of the scene show stands at each of them: at the first as the file's own,
/// at the others as copies, in the order of the scene behind all meshes of the file, "eye_2" after "eye". `Mesh::gltf`
/// is filled, copies with it; a picture that cannot be fetched is not in it and named in `Mesh::left_out`. Throws Error
/// naming the JSON pointer or byte, expected and found.
Mesh parse_gltf(std::span<const std::byte> bytes, const Fetch& fetch);

struct GltfOptions {
    bool head_motion = true;  ///< play the take's head poses on the root node
};

/// A GLB of the head performing: one translating joint per feature point, a still joint, a turning joint per eyeball,
/// and one track per joint. Everything else that `mesh.gltf` holds survives.
std::vector<std::byte> format_glb(const Mesh& mesh, const Rig& rig, const Skin& skin, const Take& take,
                                  const GltfOptions& options = {});

/// A GLB of the head performing by morph targets with one weights track, sparse where that is smaller; without times a
/// head with shapes at rest. A mesh of the file gets the targets that list a vertex of it, be it with a delta of zero.
std::vector<std::byte> format_glb(const Mesh& mesh, const MorphTrack& track);

/// A rig file: the neutral head with its skin, playable by any engine, and in the extension MIEN_rig the exact signed
/// weights and feature points (docs/rig-file.md).
std::vector<std::byte> format_rig(const Mesh& mesh, const Rig& rig, const Skin& skin);

/// Whether the document that a mesh came from holds a rig of ours.
bool is_rig(const Mesh& mesh);

/// Reads a rig file back: the neutral mesh and the exact rig. Throws Error if the GLB holds no MIEN_rig extension.
struct RigFile {
    Mesh mesh;
    Rig rig;
};
RigFile parse_rig(std::span<const std::byte> bytes);

}  // namespace mien
