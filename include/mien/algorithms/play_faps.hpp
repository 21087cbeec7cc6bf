// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <string>
#include <vector>

#include "mien/face.hpp"
#include "mien/fap.hpp"
#include "mien/take.hpp"

namespace mien {

/// A point of which a stream tells the place, and along which axes.
struct ToldPoint {
    std::string id;
    Axes axes;
};

/// The points of a face whose places a stream tells, in the face's order: those that a parameter moves which it ever
/// sends, all of the tongue when it sends one of them, and those of parts of the face (the standard's groups; the lips,
/// the jaw and the tongue are one) that it leaves alone.
///
/// Lips and jaw have a parameter for some axes only. Where the stream moves the jaw along another, or pushes a lip
/// (FAPs 3, 14 to 17), that axis is not told; all others are, as resting.
std::vector<ToldPoint> told_points(const FapStream& stream, const Fapu& fapu);

/// The motion of all points of a face under a stream: what it tells as `to_take` has it, and the rest as the skin
/// carries it (`complete`), so that a lower lip goes back with the jaw and not only down.
///
/// `stream`: as `resolve_faps` gives it, with `carried_contours` of the face. `fapu`: of the face. Throws Error if the
/// stream tells no point of the face.
Take play_faps(const Face& face, const FapStream& stream, const Fapu& fapu);

}  // namespace mien
