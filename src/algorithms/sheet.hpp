// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "algorithms/fill_pockets.hpp"
#include "algorithms/movers.hpp"

#include "mien/algorithms/rig_biharmonic.hpp"

namespace mien {

/// The skin that a sheet is solved on, and the closed pockets that follow it.
struct SheetSkin {
    Mesh solved;
    Pockets pockets;
};
SheetSkin sheet_skin(const Face& face, const Weld& weld, const std::vector<bool>& solved, double scale);

/// How a sheet follows its points. All other places keep still.
struct Sheet {
    std::vector<std::uint32_t> free;  ///< places that move and hold no point, those of pockets last
    Eigen::MatrixXd weights;          ///< free x movers
    Eigen::MatrixXd energy;           ///< movers x movers: the sheet's energy as a function of its points
};

/// Minimises x'(L M^-1 L + a L)x with the movers fixed; lengths of `options` are in `scale`.
Sheet solve_sheet(const Mesh& mesh, const SheetSkin& skin, const Weld& weld, const Movers& movers, double scale,
                  const BiharmonicOptions& options);

}  // namespace mien
