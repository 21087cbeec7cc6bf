// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "actor.hpp"
#include "verb.hpp"

#include "mien/draw/annotate.hpp"
#include "mien/picture.hpp"
#include "mien/render/camera.hpp"
#include "mien/render/look.hpp"
#include "mien/render/renderer.hpp"

namespace mien::cli {

/// The size in pixels that a text such as "640x480" gives; `wanted` for an empty one. Throws Error.
struct Size {
    std::uint32_t width = 0, height = 0;
};
Size size_of(const std::string& text, Size wanted);

/// Flags of verbs that draw: how a head is looked at.
struct LookFlags {
    std::string size;  ///< "640x480"; empty: as the verb likes
    View view = View::front;
    std::string close_up;  ///< a feature point, "eyes", "mouth" or "points"; empty: the whole head
    Quality quality = Quality::full;
    std::uint32_t passes = 0;  ///< of full quality; 0: as the verb likes
    bool wire = false;
    bool points = false;  ///< feature points with their ids
    bool software = false;
    double time = 0;  ///< at which a close-up looks for its feature points
};
void add_look_flags(CLI::App& verb, LookFlags& flags);
/// Those of them that every picture has: not which part of the head it shows, nor its points.
void add_picture_flags(CLI::App& verb, LookFlags& flags);

/// What the colours on a head mean instead of its materials.
struct PaintFlags {
    std::string weights;          ///< a feature point whose influence is shown; empty: none
    std::filesystem::path truth;  ///< an animation that the distance to is shown; empty: none
    double error_max = 2;         ///< percent of the head's height at the scale's end
};

/// Actors before a camera, each drawn alone.
class Stage {
public:
    Stage(const LookFlags& look, const PaintFlags& paint, Size size);

    /// Throws Error if what the flags ask for is not on the actor: a point, a rig.
    void enter(Actor actor);
    /// The animation that the others' distance to is shown. Throws Error if it has other vertices than an actor.
    void set_truth(Actor actor);

    [[nodiscard]] std::size_t size() const { return actors_.size(); }
    [[nodiscard]] const std::string& name(std::size_t actor) const { return actors_[actor].name; }
    [[nodiscard]] double seconds() const;  ///< of the longest
    [[nodiscard]] std::string device() const { return renderer_.device(); }
    [[nodiscard]] std::optional<Legend> legend() const;

    /// Looks at all actors as these flags say from now on.
    void look(const LookFlags& flags);
    /// Paints the weights of this feature point on all actors from now on; an empty name: their materials again.
    void show_weights(const std::string& point);

    std::vector<double> key_times(std::size_t count);
    Picture picture(std::size_t actor, double time);

private:
    void paint_weights(std::size_t actor);
    void paint_error(std::size_t actor);
    Camera camera(const Actor& actor, ModelId model);

    LookFlags flags_;
    PaintFlags paint_;
    Size size_;
    Renderer renderer_;
    std::vector<Actor> actors_;
    std::vector<ModelId> models_;
    std::vector<Camera> cameras_;
    std::optional<Actor> truth_;
    ModelId truth_model_ = 0;
};

}  // namespace mien::cli
