// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <span>
#include <vector>

#include "mien/vec.hpp"

namespace mien::samples {

/// A smooth displacement along a line from `from` to `to`: full on the line, (1 - d^2)^2 at distance d * radius, none
/// from there on. Strokes are given for the subject's left half.
struct Stroke {
    Vec3 from, to;
    double radius = 1;
    Vec3 move;
};

/// How much of a stroke a place gets, 0 to 1.
double share(const Vec3& from, const Vec3& to, double radius, const Vec3& place);

/// The sum of the strokes' displacements at a place.
Vec3 stroke_sum(std::span<const Stroke> strokes, const Vec3& place);

/// A ball in which everything grows: by `scale` up to `inner` from its centre, less and less up to `outer`.
struct Swell {
    Vec3 centre;
    double inner = 1, outer = 2, scale = 1;
};

/// One swell after the other, each with its mirror image at x = 0 unless its centre lies there.
Vec3 swollen(std::span<const Swell> swells, const Vec3& place);

/// What the cage is too coarse for: philtrum, cupid's bow, wings of the nose, cheek bones, tear trough, sternomastoid.
std::span<const Stroke> face_strokes();

/// Helix, scapha, antihelix with its crura, concha, tragus, antitragus and lobe.
std::vector<Stroke> ear_strokes();

}  // namespace mien::samples
