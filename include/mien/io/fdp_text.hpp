// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "mien/fdp.hpp"

namespace mien {

/// How a file's displacements are meant, of which sources tell two ways. Files written by mien are read by the
/// defaults.
struct FdpTextOptions {
    /// Displacements are in units of the FAP: what is stored times the FAP's unit is the way per FAP unit. Else they
    /// are in the unit of the model.
    bool displacements_in_units = true;
    /// In intervals below zero displacements are the way per unit of downward motion. Else they are multiplied by the
    /// negative value, so that a linear table has the same vector on both sides.
    bool downward_below_zero = false;
};

/// The textual form of MPEG-4's scenes (BIFS text, the syntax of VRML97): the first FDP node of the file with its
/// featurePointsCoord, faceSceneGraph and faceDefTables, and of a WorldInfo node the FAPU and the unit of the model.
///
/// Every IndexedFaceSet of the scene graph becomes a part and every Transform with a DEF name a node of the table;
/// transforms of the scene graph are applied. 84 points in the order of the standard; one with an infinite coordinate
/// is not given. FAPU that no WorldInfo names come from the points, by their definition. Of what is not known nodes and
/// fields are read over. Throws Error naming the line, what was expected and what was found: brackets that do not
/// close or lie deeper than 64, indices out of range, counts that do not fit, names that nothing has, a unit that a
/// table needs and the file does not tell, no FDP and no FAPU.
Fdp parse_fdp_text(std::span<const std::byte> bytes, const FdpTextOptions& options = {});

/// The same back: points of the standard, units, model and table, each where it is there. The table reads back equal;
/// only the numbers of transforms may change in their last digit, once. Numbers are the shortest that do so. Names are
/// kept with blanks and the like as %20.
///
/// Throws Error if the table does not fit the mesh, if a unit that it needs is not above 0, and if the faces of a node
/// are not whole, or lie partly in another node: a scene graph is a tree of whole shapes.
std::string format_fdp_text(const Fdp& fdp);

}  // namespace mien
