// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Tension biharmonic weights (docs/methods.md), solved on the sheet of sheet.hpp. Rows are cut by refitting: the
// inverse of the sheet's energy is how points move together when the sheet is all that is known.

#include "mien/algorithms/rig_biharmonic.hpp"

#include <fmt/format.h>
#include <optional>
#include <vector>

#include "algorithms/island.hpp"
#include "algorithms/movers.hpp"
#include "algorithms/refit.hpp"
#include "algorithms/sheet.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

void check_options(const BiharmonicOptions& options) {
    if (!(options.tension >= 0)) throw Error(fmt::format("tension: expected 0 or more, found {}", options.tension));
    if (!(options.far_radius > 0))
        throw Error(fmt::format("far radius: expected more than 0, found {}", options.far_radius));
}

}  // namespace

Rig rig_biharmonic(const Face& face, const BiharmonicOptions& options) {
    check_options(options);
    const double scale = face_scale(face);
    std::optional<SheetSkin> skin;  // the same for all axes
    return rig_by_axes(
        "biharmonic", face, [&](const Weld& weld, const std::vector<bool>& solved, const Movers& movers) {
            if (!skin) skin = options.cut_pockets ? sheet_skin(face, weld, solved, scale) : SheetSkin{face.mesh, {}};
            const Sheet sheet = solve_sheet(face.mesh, *skin, weld, movers, scale, options);
            return refit_rows(weld.vertex.size(), movers, sheet.free, sheet.weights, covariance_of(sheet.energy),
                              options.influences);
        });
}

}  // namespace mien
