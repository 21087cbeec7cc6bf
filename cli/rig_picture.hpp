// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <string>

#include "mien/mesh.hpp"
#include "mien/picture.hpp"
#include "mien/rig.hpp"

namespace mien::cli {

/// A sheet that shows a rig: the head with its feature points from two sides, then how far single points move the skin.
Picture rig_picture(const std::string& name, const Mesh& mesh, const Rig& rig);

}  // namespace mien::cli
