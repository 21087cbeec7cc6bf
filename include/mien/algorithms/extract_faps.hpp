// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mien/algorithms/faps.hpp"
#include "mien/algorithms/upright_sequence.hpp"
#include "mien/fap.hpp"

namespace mien {

/// An eyeball of its own in an animated head: what it did, row by row.
struct MovingEyeball {
    std::string name;                     ///< "left eye", "right eye": the subject's
    std::string pupil;                    ///< the feature point that it stands for: "3.5", "3.6"
    std::vector<std::uint32_t> vertices;  ///< ascending: the ball and what lies in it
    Vec3 centre;                          ///< neutral, in the mesh's unit
    std::vector<Pose> poses;              ///< per row, about the centre: p -> centre + apply(pose, p - centre)
};

/// The eyeballs of an animated head that are pieces of their own and keep their shape, each by the best rigid motion of
/// its vertices; none where eyes are part of the skin.
std::vector<MovingEyeball> moving_eyeballs(const UprightSequence& upright);

/// The animation as parameters in the units of its own face. Paper: Laftsidis et al., eq. 1, FAP = +-(FDP(t) - FDP(t0))
/// * 1024 / FAPU along the parameter's own axis, as `to_faps` does it for takes; the head's motion becomes FAPs 48 to
/// 50. Eyeballs turn as angles: those of `moving_eyeballs` by how the ball turns, others by their pupil points.
///
/// `fapu`: of the neutral head, `measure_fapu({mesh, points})`. Throws Error as `to_faps`.
FapStream extract_faps(const UprightSequence& upright, const Fapu& fapu, const ToFapsOptions& options = {});

/// Where the centre that the head turns about (`Fapu::neck`) went from its neutral place, per row: what FAPs cannot
/// say of the head's motion. In the unit of the mesh.
std::vector<Vec3> head_translations(const UprightSequence& upright, const Fapu& fapu);

}  // namespace mien
