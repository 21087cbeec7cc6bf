// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "mien/algorithms/partial.hpp"
#include "mien/fap.hpp"

namespace mien {

/// The performance as a mirror shows it: left and right change sides, and what goes to a side goes to the other one.
/// Visemes and expressions have two equal sides and stay.
FapStream mirrored(const FapStream& stream);

/// The stream at `time` (seconds): linear between the frames before and after where both send a parameter, else as the
/// nearer of them, the earlier of two; held at the ends. Its number is 0. Throws Error if the stream has no frame.
FapFrame frame_at(const FapStream& stream, double time);

struct RetimeOptions {
    double speed = 1;  ///< above 0; 2: in half of the time
    double rate = 0;   ///< frames per second; 0: as before
};

/// The same performance faster or slower, or at another rate: every frame is read between those of the stream. Throws
/// Error if the stream has no frame, if speed or rate is no such number, or if the result had more than 4e6 frames.
FapStream retimed(const FapStream& stream, const RetimeOptions& options);

/// The parameters, by number, that move a part of the face: a region as in `part_columns` or "head", the id of a
/// feature point, or the name of a parameter. Throws Error if it is none of them.
std::vector<int> part_faps(std::string_view part);

/// Parts of the face moved more or less: their parameters times a strength; where parts overlap the last one counts.
/// Visemes and expressions stay; `resolve_faps` makes parameters of them. Throws Error as `part_faps` does, or at a
/// strength that is no finite number.
FapStream scaled(const FapStream& stream, std::span<const PartStrength> strengths);

/// One after the other, each as `resolve_faps` says it, at the rate of the first; what a stream does not move rests
/// while it lasts. Throws Error if there is no stream, or one without frames.
FapStream concatenated(std::span<const FapStream> streams);

/// Both at once, (1 - share) * a + share * b, each as `resolve_faps` says it, at the rate of `a`; what one of them does
/// not move rests in it, and one that ends earlier keeps its last frame. Throws Error if one has no frame, or at a
/// share that is no finite number.
FapStream blended(const FapStream& a, const FapStream& b, double share);

/// What a stream does with one parameter.
struct FapStatistics {
    int fap = 0;             ///< 3 to 68
    std::size_t frames = 0;  ///< that send it
    std::int32_t low = 0, high = 0;
    double mean = 0, deviation = 0;  ///< over the frames that send it
    std::size_t outside = 0;         ///< values beyond the limits of the standard's table
    std::size_t negative = 0;        ///< negative values, where it is meant to be positive
};

/// Of every parameter that the stream sends, in order.
std::vector<FapStatistics> statistics(const FapStream& stream);

}  // namespace mien
