// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What all riggers share: a point that is constrained along an axis is no feature point there (Kshirsagar et al.,
// section 2), so that a rig is three sets of weights, equal unless some point is constrained.

#include "algorithms/movers.hpp"

#include <algorithm>
#include <array>

#include "algorithms/face_check.hpp"

#include "mien/algorithms/attach.hpp"

namespace mien {

namespace {

Movers movers_along(const Face& face, const Weld& weld, const std::vector<bool>& solved, int axis) {
    Movers movers;
    for (std::uint32_t i = 0; i < face.points.size(); ++i) {
        const std::uint32_t place = weld.place[face.points[i].vertex];
        if (!solved[place] || !moves_along(face.points[i], axis)) continue;
        movers.points.push_back(static_cast<std::uint16_t>(i));
        movers.places.push_back(place);
    }
    return movers;
}

std::uint32_t count_unreached(const Rig& rig, const Weld& weld, const std::vector<bool>& solved) {
    std::uint32_t unreached = 0;
    for (std::size_t v = 0; v < vertex_count(rig); ++v)
        if (solved[weld.place[v]] && rig.row_starts[v] == rig.row_starts[v + 1]) ++unreached;
    return unreached;
}

}  // namespace

Rig rig_by_axes(std::string_view method, const Face& face, const RowsAlong& rows_along) {
    const Weld joined = weld(face.mesh);
    check_face(face, joined);
    const std::vector<bool> solved = solved_places(face, joined);
    std::array<WeightRows, 3> rows;
    std::array<const WeightRows*, 3> axes{};
    std::array<Movers, 3> movers;
    for (int axis = 0; axis < 3; ++axis) {
        movers[axis] = movers_along(face, joined, solved, axis);
        const auto same = std::find_if(movers.begin(), movers.begin() + axis,
                                       [&](const Movers& m) { return m.points == movers[axis].points; });
        axes[axis] = &rows[same - movers.begin()];
        if (same == movers.begin() + axis) rows[axis] = rows_along(joined, solved, movers[axis]);
    }
    Rig rig;
    rig.method = method;
    rig.points = face.points;
    rig.rest = face.mesh.positions;
    spread_rows(rig, joined, axes);
    rig.unreached = count_unreached(rig, joined, solved);
    attach_islands(rig, face, joined);
    return rig;
}

}  // namespace mien
