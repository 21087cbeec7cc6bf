// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Tension biharmonic weights (docs/methods.md): the sheet's energy Q = L M^-1 L + a L with feature points held at one
// or zero and far places at zero. Rows are cut by refitting: Q's Schur complement on the points, E, is the energy of
// the sheet as a function of its points, and E^-1 is how points move together when the sheet is all that is known.

#include "mien/algorithms/rig_biharmonic.hpp"

#include <fmt/format.h>
#include <optional>
#include <vector>

#include "algorithms/island.hpp"
#include "algorithms/laplacian.hpp"
#include "algorithms/movers.hpp"
#include "algorithms/pockets.hpp"
#include "algorithms/refit.hpp"
#include "algorithms/sparse_solve.hpp"

#include "mien/algorithms/surface_distance.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

enum class Role : std::uint8_t { still, free, held };

// Free are the places that a mover reaches within `radius` along the surface.
std::vector<Role> roles(const Mesh& mesh, const Weld& weld, const Movers& movers, double radius) {
    const EdgeGraph graph = edge_graph(mesh, weld);
    std::vector<Role> role(weld.vertex.size(), Role::still);
    for (const std::uint32_t place : movers.places) {
        const std::vector<double> d = surface_distances(graph, place, radius);
        for (std::size_t p = 0; p < d.size(); ++p)
            if (d[p] <= radius) role[p] = Role::free;
    }
    for (const std::uint32_t place : movers.places) role[place] = Role::held;
    return role;
}

Sparse energy(const Laplacian& surface, double tension) {
    const Eigen::VectorXd inverse = surface.areas.cwiseInverse();
    const Sparse& l = surface.stiffness;
    Sparse q = l * inverse.asDiagonal() * l;
    q += tension * l;
    return q;
}

struct SheetWeights {
    std::vector<std::uint32_t> free;  // places, ascending
    Eigen::MatrixXd weights;          // free x movers
    Eigen::MatrixXd covariance;       // movers x movers
};

SheetWeights solve_sheet(const Sparse& q, const std::vector<Role>& role, const Movers& movers) {
    SheetWeights sheet;
    for (std::uint32_t p = 0; p < role.size(); ++p)
        if (role[p] == Role::free) sheet.free.push_back(p);
    const Sparse to_free = picks(q.rows(), sheet.free), to_held = picks(q.rows(), movers.places);
    const Sparse q_free = to_free.transpose() * q * to_free;
    const Sparse q_between = to_free.transpose() * q * to_held;
    const Sparse q_held = to_held.transpose() * q * to_held;
    sheet.weights = solve_checked(q_free, -Eigen::MatrixXd(q_between), "biharmonic rig");
    sheet.covariance = covariance_of(Eigen::MatrixXd(q_held) + q_between.transpose() * sheet.weights);
    return sheet;
}

// The skin that is solved, and what follows its rim.
struct SolvedSkin {
    Mesh solved;
    std::vector<std::uint32_t> pocket;  // places
};

SolvedSkin skin_of(const Face& face, const Weld& weld, const std::vector<bool>& solved, bool cut_pockets) {
    if (!cut_pockets) return {face.mesh, {}};
    const std::vector<bool> is_pocket = closed_pockets(face, weld, solved);
    SolvedSkin skin;
    for (std::uint32_t p = 0; p < is_pocket.size(); ++p)
        if (is_pocket[p]) skin.pocket.push_back(p);
    skin.solved = skin.pocket.empty() ? face.mesh : without_places(face.mesh, weld, is_pocket);
    return skin;
}

// Adds the rows of the pockets to those of the sheet.
void carry_pockets(SheetWeights& sheet, const Mesh& mesh, const Weld& weld, const Movers& movers,
                   const std::vector<std::uint32_t>& pocket) {
    if (pocket.empty()) return;
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(std::ssize(weld.vertex), std::ssize(movers.places));
    all(sheet.free, Eigen::all) = sheet.weights;
    for (Eigen::Index m = 0; m < all.cols(); ++m) all(movers.places[static_cast<std::size_t>(m)], m) = 1;
    const Eigen::MatrixXd carried = fill_pockets(mesh, weld, pocket, all);
    const Eigen::Index free = sheet.weights.rows();
    sheet.weights.conservativeResize(free + carried.rows(), Eigen::NoChange);
    sheet.weights.bottomRows(carried.rows()) = carried;
    sheet.free.insert(sheet.free.end(), pocket.begin(), pocket.end());
}

void check_options(const BiharmonicOptions& options) {
    if (!(options.tension >= 0)) throw Error(fmt::format("tension: expected 0 or more, found {}", options.tension));
    if (!(options.far_radius > 0))
        throw Error(fmt::format("far radius: expected more than 0, found {}", options.far_radius));
}

}  // namespace

Rig rig_biharmonic(const Face& face, const BiharmonicOptions& options) {
    check_options(options);
    const double scale = face_scale(face);
    std::optional<SolvedSkin> skin;  // the same for all axes
    return rig_by_axes(
        "biharmonic", face, [&](const Weld& weld, const std::vector<bool>& solved, const Movers& movers) {
            if (!skin) skin = skin_of(face, weld, solved, options.cut_pockets);
            const std::vector<Role> role = roles(skin->solved, weld, movers, options.far_radius * scale);
            const Sparse q = energy(laplacian(skin->solved, weld), options.tension / (scale * scale));
            SheetWeights sheet = solve_sheet(q, role, movers);
            carry_pockets(sheet, face.mesh, weld, movers, skin->pocket);
            return refit_rows(role.size(), movers, sheet.free, sheet.weights, sheet.covariance, options.influences);
        });
}

}  // namespace mien
