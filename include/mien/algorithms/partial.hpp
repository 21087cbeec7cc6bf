// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mien/take.hpp"

namespace mien {

/// The columns of a take that belong to a part of the face, in the take's order. A part is a region (`mouth`, `jaw`,
/// `brows`, `lids`, `eyes`, `nose`, `cheeks`; groups of MPEG-4 points) or the id of a column. Throws Error if
/// it is neither.
std::vector<std::size_t> part_columns(const Take& take, std::string_view part);

/// A part of the face and how strongly it moves: 1 as performed, 0 not at all.
struct PartStrength {
    std::string part;
    double strength = 1;
};

struct PartialOptions {
    std::vector<std::string> only;             ///< parts that move; all when empty
    std::vector<std::string> without;          ///< parts that do not
    std::vector<PartStrength> strengths = {};  ///< of those that do; where parts overlap, the last one counts
};

/// Partial retargeting: the same take with the parts that do not move held at rest and the motion of the others scaled.
/// `rest`: one position per column. It works on the performer's take as on the target's; done before the retarget, lids
/// and lips keep their contact at any strength. Lost samples stay lost. Dutreve et al., section 4 (partial transfer).
/// Throws Error if a part is unknown or a strength is not a finite number.
Take partial(const Take& take, std::span<const Vec3> rest, const PartialOptions& options);

/// The face in `take` with some parts from `other`, another performance on the same face: at the times of `take`, read
/// between the rows of `other` and held at its ends. Columns of those parts that `take` lacks come along; all else of
/// `other` is left out. Head poses are those of `take`. Throws Error if a part is unknown, or if `other` has no row.
Take merged(const Take& take, const Take& other, std::span<const std::string> parts);

}  // namespace mien
