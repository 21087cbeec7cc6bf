// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <span>
#include <string>

#include "shape_stage.hpp"

#include "mien/algorithms/learn_fat.hpp"
#include "mien/face.hpp"
#include "mien/fap.hpp"
#include "mien/picture.hpp"

namespace mien::cli {

/// A sheet of the neutral head: where its replay is off the truth (`error`: per vertex, in the mesh's unit), and for
/// every parameter the vertices that depend on it, by how far its largest value in the stream takes them.
Picture extract_picture(const std::string& name, const Face& face, const LearntFat& learnt, const FapStream& stream,
                        std::span<const double> error, const LookFlags& look);

}  // namespace mien::cli
