// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mien/io/gltf.hpp"
#include "mien/mesh_sequence.hpp"

namespace mien {

/// How an animated head is read.
struct SequenceOptions {
    std::filesystem::path head;  ///< the neutral head of a point cache (.mdd .pc2), which holds positions alone
    /// Rows per second, above 0; 0: the rows of the file where it has some (keys of all channels at the same times, 8
    /// a second or more; the times of an .mdd), the rate of the keys where those lie apart, else 30. A .pc2, a folder
    /// and an .mdd whose times do not rise state none, and need one.
    double rate = 0;
    std::string animation;  ///< by name, or by number from 0; empty: the first
};

/// What an animation of a file moves, and when. Names are those of the file; a thing without one is called by its
/// number.
struct Animation {
    std::string name;
    double start = 0;                 ///< seconds, of the first key
    double seconds = 0;               ///< from the first key to the last
    double rate = 0;                  ///< rows per second that `SequenceOptions::rate` 0 gives
    std::uint64_t rows = 0;           ///< how many that are
    std::vector<std::string> nodes;   ///< whose translation, rotation or scale changes
    std::vector<std::string> morphs;  ///< shapes whose weight changes, each once
    std::vector<std::string> skins;   ///< meshes that hang on a joint that moves
};

/// One animation of a glTF 2.0 (text or binary) on all its meshes: translation, rotation, scale of nodes, weights of
/// morph targets, skins; STEP, LINEAR (turns along the shorter arc) and CUBICSPLINE (specification, 3.11 and appendix
/// C). The mesh and the order and space of the positions are those of `parse_gltf`; meshes that the scene does not
/// show, points and lines stay where they are. Times count from the first key.
///
/// Throws Error naming the JSON pointer or byte, expected and found, as `parse_gltf` does, for a file without an
/// animation that moves a mesh and for an unknown one. `positions` throws Error where a row runs over what a float
/// holds.
MeshSequence parse_gltf_sequence(std::span<const std::byte> bytes, const Fetch& fetch,
                                 const SequenceOptions& options = {});

/// What each animation of a glTF holds.
std::vector<Animation> parse_gltf_animations(std::span<const std::byte> bytes, const Fetch& fetch);

}  // namespace mien
