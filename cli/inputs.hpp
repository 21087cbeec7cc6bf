// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verb.hpp"

#include "mien/algorithms/head.hpp"
#include "mien/algorithms/retarget.hpp"
#include "mien/algorithms/rig_prior.hpp"
#include "mien/algorithms/riggers.hpp"
#include "mien/algorithms/tracks.hpp"
#include "mien/face.hpp"
#include "mien/take.hpp"

namespace mien::cli {

/// Flags of verbs that rig a head.
struct FaceFlags {
    std::filesystem::path head;
    std::filesystem::path points;
    std::string method;
    RigOptions rig;
    std::vector<std::filesystem::path> examples;         ///< heads with shapes: this one, or others
    std::vector<std::filesystem::path> examples_points;  ///< of the others, in their order
    bool linear_prior = false;
};
void add_face_flags(CLI::App& verb, FaceFlags& flags);
void add_rig_flags(CLI::App& verb, FaceFlags& flags);

/// Reads the head and its points and tells the report about them. Throws Error if the file holds no mesh.
Face load_face(const FaceFlags& flags, Report& report);

/// Every file that is read.
std::vector<std::filesystem::path> input_files(const FaceFlags& flags);

/// The shapes of `--examples`: the head's own, and those of other heads carried over to it; none without the flag.
/// `whole`: the head with all its points, through which shapes are carried over.
Examples load_examples(const Face& whole, const FaceFlags& flags, Report& report);

/// Binds the rig, learning from example shapes where there are any, and tells the report how every part of the head was
/// reached.
Rig bind_rig(const Face& face, const Examples& examples, const FaceFlags& flags, Report& report);

/// Whether a file holds a take, by its extension.
bool is_take(const std::filesystem::path& file);

/// Flags of verbs that take a performance.
struct TakeFlags {
    std::filesystem::path take;
    std::filesystem::path map;
    std::string head = "least-squares";
    HeadOptions head_options;
    NeutralOptions neutral;
    double fill_gaps = 0;  ///< seconds; 0: off
    double low_pass = 0;   ///< Hz; 0: off
};
void add_take_flags(CLI::App& verb, TakeFlags& flags);

/// Warns of rows that the take's file promises and does not have.
void report_missing(const Take& take, Report& report);

/// Reads the take, gives its columns their feature point ids, takes the head's motion out, fills and smooths as asked,
/// and tells the report what was lost and what was done.
Take load_take(const TakeFlags& flags, Report& report);

/// Flags of verbs that retarget.
void add_retarget_flags(CLI::App& verb, RetargetOptions& options);

/// Fits the retarget, applies it and tells the report which points are driven.
Take load_onto(const Take& take, const Face& face, const RetargetOptions& options, Report& report);

}  // namespace mien::cli
