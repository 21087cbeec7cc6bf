// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <string>
#include <vector>

#include "mien/take.hpp"

namespace mien {

struct HeadOptions {
    enum class Method {
        least_squares,  ///< best rigid fit over all head markers that are seen
        three_markers,  ///< Kshirsagar et al., eq. 6-10: linear, translation invariant, with a pseudo-correspondence
    };
    Method method = Method::least_squares;
    /// Columns that ride on the skull. Empty: chosen by name (see `head_markers`).
    std::vector<std::string> markers;
    /// Row whose head pose is taken as neutral.
    std::size_t reference = 0;
};

/// The columns of a take that are best taken as rigid on the skull, by feature-point id and by motion: ears (10.x),
/// skull and hair line (11.x), nose bridge (9.12, 9.6, 9.7) and names with a word that begins with head, those of them
/// that keep their distances over the take; where too few do, the columns that are left when those whose mutual
/// distances vary most are taken away until the rest is rigid. At least three that are not on a line (two for a planar
/// take), or empty when there are none.
std::vector<std::string> head_markers(const Take& take);

/// Takes the rigid motion of the head out of every point, so that what is left is the face, and keeps the pose per row
/// in `Take::head`: captured = apply(head, returned). Poses that the take has already are kept as their outer part.
///
/// Lost markers are tolerated: both methods use those seen in the row; where these do not tell a pose it is carried
/// over from the rows around (interpolated, held at the ends). A planar take is turned and shifted in its plane. Throws
/// Error if a named marker is not in the take, if fewer than three are given (two for a planar take), or if they lie on
/// a line; if none are given and none are found; if the reference is not in the take.
Take remove_head_motion(const Take& take, const HeadOptions& options = {});

}  // namespace mien
