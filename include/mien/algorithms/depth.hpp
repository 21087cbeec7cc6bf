// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "mien/algorithms/tracks.hpp"
#include "mien/take.hpp"

namespace mien {

/// A take from a frontal picture with the depth that its points are likely to have, so that lips and chin do not slide
/// through the face of a target. The neutral gets the depth of an ordinary face; the motion gets 0.7 of the mean of two
/// estimates: each point's depth from its own x and y, as it goes in known expressions, and the depth of the mixture of
/// those expressions, none below zero, that explains all x and y best. Points that no expression moves keep their
/// depth.
///
/// The result is not planar. Its axes are those of the picture, with y up: a picture whose y goes down is turned over.
/// The head's own motion should have been taken out. Columns need MPEG-4 ids. Takes that are not planar, or have fewer
/// than three known points, come back as they are. Throws Error if the neutral rows are not in the take.
Take with_depth(const Take& take, const NeutralOptions& options = {});

}  // namespace mien
