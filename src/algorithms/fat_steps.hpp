// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The parts of what a face animation table does in a frame: see deform_fat.cpp.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "mien/affine.hpp"
#include "mien/fat.hpp"

namespace mien {

/// What a frame asks of a table: its value, or a viseme's share of the blend, or an expression's intensity; 0 where it
/// does not send it.
double fat_value(const FapFrame& frame, const FaceDefTables& table) noexcept;

/// How far a value goes through interval `j` on its way from zero; the outermost intervals have no end.
double fat_step(std::span<const std::int32_t> borders, std::size_t j, double value) noexcept;

/// What a node does to its vertices in a frame, and the same without its scale; exactly nothing where no table of it is
/// asked for.
Affine fat_map(const Fat& fat, std::size_t node, const FapFrame& frame) noexcept;
Pose fat_pose(const Fat& fat, std::size_t node, const FapFrame& frame) noexcept;

}  // namespace mien
