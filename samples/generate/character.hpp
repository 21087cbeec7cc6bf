// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What makes one head differ from the next: strokes and swells on the neutral form, colours, brows, lashes and hair.
// All places are those of the neutral head, in millimetres, for the left half.

#pragma once

#include <span>
#include <string>
#include <vector>

#include "sculpt.hpp"
#include "surface.hpp"

namespace mien::samples {

/// Red, green and blue of sRGB, 0 to 255.
using Tint = Vec3;

struct SkinLook {
    Tint skin, flush, lips;  ///< flush: towards which cheeks, nose and ears go
    double flushing = 0.3;
    double beard = 0;     ///< how much a shaven beard shows, 0 to 1
    double freckles = 0;  ///< 0 to 1
    double make_up = 0;   ///< shade on the upper lids, 0 to 1
};

struct IrisLook {
    Tint outer, inner;
    double pupil = 0.36;  ///< share of the iris' radius
};

struct BrowLook {
    Tint colour;
    std::vector<Vec3> path;  ///< from the nose outwards
    double half_width = 3.5, length = 7.5, thickness = 0.5;
    int hairs = 90;
};

struct LashLook {
    Tint colour;
    double upper = 8, lower = 4, thickness = 0.4;
};

/// A place where the hair stands higher (or lower) than elsewhere.
struct HairRise {
    Vec3 from, to;
    double radius = 30, rise = 5;
};

/// A tapered strand that lies on the hair or hangs from it.
struct Lock {
    std::vector<Vec3> path;
    double half_width = 5, thickness = 3;
    bool both_sides = true;  ///< mirrored too
};

/// Hair as a sculptor makes it: a cap from the hair line to a pole, rippled along the strands, with locks and a bun.
struct HairLook {
    Tint dark, light;
    std::vector<Vec3> line;        ///< from the middle of the forehead to the middle of the nape
    Vec3 pole{0, 60, -80};         ///< where the strands meet
    double height = 4, edge = 12;  ///< how high the cap stands, and how far from the hair line it reaches that height
    double ripples = 40, ripple_depth = 0.8, twist = 0;
    std::vector<HairRise> rises;
    std::vector<Lock> locks;
    Vec3 bun;  ///< its middle
    double bun_radius = 0;
};

struct Character {
    std::string name;   ///< stem of its files
    std::string title;  ///< in a sentence: "the sample woman"
    std::vector<Stroke> strokes;
    std::vector<Swell> swells;
    double eye_depth = 0;  ///< how far the eyeballs lie behind those of the neutral head
    SkinLook skin;
    IrisLook iris;
    BrowLook brow;
    LashLook lash;
    HairLook hair;
};

/// The cast: head (a woman), man, cartoon. The first has the published proportions of the README.
std::span<const Character> cast();

/// Where a place of the neutral head goes.
Vec3 shaped(const Character& character, const Vec3& place);

/// The left eye of a character: the neutral globe, moved and scaled.
struct EyePlace {
    Vec3 centre;
    double scale = 1;
};
EyePlace left_eye_place(const Character& character);

}  // namespace mien::samples
