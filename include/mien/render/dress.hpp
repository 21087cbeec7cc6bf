// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "mien/render/renderer.hpp"
#include "mien/scene.hpp"

namespace mien {

/// Gives a face the look of one where its file says nothing.
///
/// - A material that is plain (white, no picture, all else as glTF's defaults) is replaced by one for what the surface
///   is: an eye, teeth, gums, a tongue, lashes or brows by the name of the surface or the material; otherwise skin.
/// - A material that is neither metal nor see-through and is called skin, head, face or body, or that most of the
///   vertices wear which the rig moves, lets light travel under it as skin does, unless it says how far itself. If it
///   is white all over it gets the colour of skin.
void dress(Scene& scene, const Movement& movement = {});

}  // namespace mien
