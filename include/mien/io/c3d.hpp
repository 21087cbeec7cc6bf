// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>

#include "mien/take.hpp"

namespace mien {

/// C3D, the binary format of motion capture: the tracks of its points, their labels, rate and unit, in the number
/// formats of PC, DEC and SGI machines, integer and real, with any number of frames. The first frame is at 0 s whatever
/// its number. A sample with a negative residual is lost; so is one with a coordinate that is no number or beyond 1e15.
/// A point without a label is called "point 12". Analog channels and events are left out, axes stay as they are.
///
/// A file that ends early gives the frames that are whole; `Take::missing_rows` says how many it promises beyond.
/// Throws Error naming what was expected and what was found: no C3D file, a processor that is not known, parameters or
/// data past the end, no points, no frames, no whole frame, a rate or a scale that is no number, a label given twice.
Take parse_c3d(std::span<const std::byte> bytes);

}  // namespace mien
