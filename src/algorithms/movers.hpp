// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "algorithms/weight_rows.hpp"

#include "mien/algorithms/weld.hpp"
#include "mien/rig.hpp"

namespace mien {

/// The feature points that move the skin along one axis, in the order of the face. Those on eyeballs move no skin.
struct Movers {
    std::vector<std::uint16_t> points;  ///< index into the rig's points
    std::vector<std::uint32_t> places;  ///< one per mover
};

/// A rig from weights along each axis, with the face checked and the islands attached. `rows_along` is asked once for
/// every distinct set of movers and gives a row for every place; entries name rig points.
using RowsAlong = std::function<WeightRows(const Weld& weld, const std::vector<bool>& solved, const Movers& movers)>;
Rig rig_by_axes(std::string_view method, const Face& face, const RowsAlong& rows_along);

}  // namespace mien
