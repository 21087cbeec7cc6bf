// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "mien/rig.hpp"
#include "mien/scene.hpp"

namespace mien {

/// Gives a face the look of one where its file says nothing.
///
/// - A material is plain when it is light grey or white all over, without a picture, a glow or a name of its own
///   ("plain" and none count as no name). It is replaced by one for what the surface is: an eye, teeth, gums, a tongue,
///   lashes, brows or hair by the name of the surface; an eye when most of its vertices are on the rig's eyeballs;
///   otherwise skin.
/// - A material that is neither metal nor see-through and is called skin, head, face or body, or that most of the
///   vertices wear which the rig moves, lets light travel under it as skin does, unless it says how far itself. If it
///   is white all over it gets the colour of skin.
/// - What is see-through and called cornea mirrors and has no colour of its own, which would lie on the iris like milk.
///
/// `rig`: for the mesh of the same file (see `Surface::mesh_vertices`); may be null.
void dress(Scene& scene, const Rig* rig = nullptr);

}  // namespace mien
