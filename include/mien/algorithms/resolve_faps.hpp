// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <span>

#include "mien/face.hpp"
#include "mien/fap.hpp"
#include "mien/fap_interpolation.hpp"
#include "mien/fat.hpp"

namespace mien {

/// What visemes and expressions look like at full strength: the parameters in the mask, FAP units.
struct FapPoses {
    std::array<FapFrame, viseme_names.size()> visemes;
    std::array<FapFrame, expression_names.size()> expressions;
};

/// mien's own, made after the descriptions of the standard, which leaves their amounts to the decoder. Copy and change
/// them for a face that speaks otherwise.
FapPoses standard_poses();

/// Says outright what a stream leaves to its decoder, frame by frame: the result has no FAP 1 and 2, and its masks hold
/// every parameter whose value can be known. In this order of precedence a value is
///  1. what the frame sends;
///  2. what the visemes and expressions of FAPs 1 and 2 ask for, the two added: select1 * blend / 63 + select2 *
///     (1 - blend / 63), and select1 * intensity1 / 63 + select2 * intensity2 / 63. With `define` the frame's own
///     parameters become the pose of select1 from then on;
///  3. what was sent last, unless the frame's group is marked to be interpolated;
///  4. what the interpolation table says, from values that are known by now or that it gives itself. It comes before
///  the
///     two rules below because its maker knew the face and the stream and they know neither; a link that wants the
///     value of another side or contour names that one, and what a link gives serves both rules as if it was sent;
///  5. the value of the same parameter on the other side of the face;
///  6. the value of the same parameter of the other lip contour, inner or outer, but for those in `carried`.
/// FAPs 1 and 2 that are not sent hold, too; what a table gave does not, but is asked for anew in every frame. A face
/// without them and without a source rests: the parameter stays out. Throws Error where the table is refused.
FapStream resolve_faps(const FapStream& stream, FapPoses poses = standard_poses(), const FapInterpolation& fit = {},
                       const FapMask& carried = {});

/// The parameters of the lips that need no value from the other contour, because the face has the points of both: its
/// skin carries the one with the other, more roundly than the same values do.
FapMask carried_contours(std::span<const FeaturePoint> points);

/// The same for a face that has a table: visemes and expressions that the table moves vertices for stay in FAPs 1 and
/// 2, held until others are sent, and what a frame defines does not change them; the others go by `standard_poses`.
FapStream resolve_faps(const FapStream& stream, const Fat& fat, const FapInterpolation& fit = {});

}  // namespace mien
