// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verb.hpp"

#include "mien/algorithms/bake_morphs.hpp"
#include "mien/algorithms/skin.hpp"
#include "mien/mesh.hpp"
#include "mien/rig.hpp"
#include "mien/take.hpp"

namespace mien::cli {

/// Flags of verbs that write a performing head.
struct OutputFlags {
    std::filesystem::path output;
    std::string bake = "joints";
    SkinOptions skin;
    BakeOptions morphs;
    bool head_motion = false;
    double max_error = 0;  ///< share of the head's height; 0: no gate
};
void add_output_flags(CLI::App& verb, OutputFlags& flags);
void add_skin_flags(CLI::App& verb, OutputFlags& flags);

/// Refuses, before any long work, an output that is there (without --force) or that is one of the inputs.
void check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs,
                  const Common& flags);

/// Writes the head performing the take in the form that the output's name asks for, and reports what the form cost.
void write_performance(Call& call, const OutputFlags& flags, const Mesh& mesh, const Rig& rig, const Take& take);

/// Writes a head that morph targets move (.glb).
void write_morphs(Call& call, const OutputFlags& flags, const Mesh& mesh, const MorphTrack& track);

/// Writes a mesh over time as the output's name asks for, but for a .glb.
void write_cache(Call& call, const OutputFlags& flags, const MeshSequence& sequence);

/// Writes bytes unless this is a dry run, and reports them.
void write_output(Call& call, const std::filesystem::path& output, const std::vector<std::byte>& bytes);

/// Makes the skin that engines play, reports its error, and checks the quality gate.
Skin skin_for(Call& call, const OutputFlags& flags, const Mesh& mesh, const Rig& rig, const Take& take);

}  // namespace mien::cli
