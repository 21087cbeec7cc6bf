// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "report.hpp"

#include "mien/render/renderer.hpp"
#include "mien/rig.hpp"
#include "mien/scene.hpp"
#include "mien/take.hpp"

namespace mien::cli {

/// A named place on an actor: a feature point.
struct NamedPlace {
    std::string name;
    Vec3 place;
};

/// Somebody to draw: a head or an animated scene, and what moves it.
struct Actor {
    std::string name;  ///< the file's, for captions
    Scene scene;
    std::optional<Rig> rig;  ///< its points move the head, by their exact weights
    Take take;               ///< of the rig's points; without rows it rests
    TakeBinding binding;
    double seconds = 0;  ///< how long it plays; 0: it rests
};

/// Reads a head, an animated glTF file or a rig file; `take`, for rig files alone and optional, holds the motion of the
/// rig's own points. Throws Error naming the file.
Actor load_actor(const std::filesystem::path& file, const std::filesystem::path& take, Report& report);

/// The same from a head in memory; with a rig its points move it.
Actor actor_of(const std::string& name, const Mesh& mesh, std::optional<Rig> rig = {});

ModelId upload(Renderer& renderer, const Actor& actor);

/// Poses the actor's model as it is at a time.
void pose(Renderer& renderer, ModelId model, const Actor& actor, double time);

/// The box that it stays in, as far as 24 times of its motion show.
Box reach(Renderer& renderer, ModelId model, const Actor& actor);

/// Its feature points at a time: the rig's points, or the joints of a scene that are named like feature points.
std::vector<NamedPlace> points_at(const Actor& actor, double time);

/// The times at which `count` pictures show most of its motion, the first at 0.
std::vector<double> key_times(Renderer& renderer, ModelId model, const Actor& actor, std::size_t count);

}  // namespace mien::cli
