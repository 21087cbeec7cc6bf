// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/margins.hpp"
#include "algorithms/shape_field.hpp"

#include "mien/algorithms/weld.hpp"
#include "mien/face.hpp"
#include "mien/rig.hpp"

namespace mien {

/// What brings the two edges of slits together all along, and the skin around them with it: a sheet held at every place
/// of the edges and at the feature points around them. The folds beside the lids (3.9, 3.10, 3.13, 3.14) are free: held
/// where they are, they would stand out of the skin that a closing lid draws over the eye.
struct MarginCloser {
    std::vector<Margin> margins;
    Rig sheet;
    std::vector<std::uint32_t> places;  ///< one per point of the sheet
};
MarginCloser fit_margin_closer(const Face& face, const Weld& weld, const EdgeGraph& graph);

enum class Closing {
    touch,       ///< the edges meet
    as_at_rest,  ///< the edges lie to each other as they do at rest
};

/// Adds to `field` what closes one of the margins. `upper`: the share of the way that the upper edge goes, 0 to 1.
void close_margin(const MarginCloser& closer, const Face& face, const Weld& weld, std::size_t margin, Closing closing,
                  double upper, ShapeField& field);

/// Adds to `field` what makes the motion of a slit's edges an even arch (a parabola over the chord) from the corners to
/// the points in the middle, which keep theirs: a lid that one point moves hangs down there like a tent turned over.
void arch_edges(const MarginCloser& closer, const Face& face, const Weld& weld, std::size_t margin, ShapeField& field);

/// The field once more, from what it does to the sheet's places alone: smooth around edges that were moved one by one.
ShapeField drawn_by_edges(const MarginCloser& closer, const Weld& weld, const ShapeField& field);

/// A place in the pocket behind a pair of lids, and the place of the lids' edge that it follows.
struct PocketPlace {
    std::uint32_t place = 0, edge = 0;
    double share = 0;  ///< of the edge's motion: 1 at the edge, 0 from 0.15 eye distances behind it on
};

/// Skin that only the edges of lids part from the face: sockets that are closed behind the eyes. It would stretch over
/// the eyeball where it followed the lids all the way, so it keeps still but for its rim.
std::vector<PocketPlace> eye_pockets(const Face& face, const Weld& weld, const EdgeGraph& graph,
                                     const std::vector<Margin>& margins);
void follow_edges(const std::vector<PocketPlace>& pockets, ShapeField& field);

/// Keeps skin out of the eyeballs: where it slides over one it stays at least as far outside as at rest, by the share
/// of the radius there, or at 1.01 of it. Eyeballs are taken as the field turns them.
void keep_out_of_eyeballs(const Face& face, const Weld& weld, const Rig& rig, ShapeField& field);

/// Moves the edges of a pair of lids before the eyeballs, where they were tucked in behind their front.
void edges_before_eyeballs(const Margin& margin, const Face& face, const Weld& weld, const Rig& rig, ShapeField& field);

}  // namespace mien
