// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The sheet of docs/methods.md: energy Q = L M^-1 L + a L with feature points held at one or zero and far places at
// zero. Closed pockets are left out and follow the skin round them. Q's Schur complement on the points is the
// energy of the sheet as a function of its points.

#include "algorithms/sheet.hpp"

#include "algorithms/laplacian.hpp"
#include "algorithms/pockets.hpp"
#include "algorithms/sparse_solve.hpp"

#include "mien/algorithms/surface_distance.hpp"

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

Sparse stiffness(const Laplacian& surface, double tension) {
    const Eigen::VectorXd inverse = surface.areas.cwiseInverse();
    const Sparse& l = surface.stiffness;
    Sparse q = l * inverse.asDiagonal() * l;
    q += tension * l;
    return q;
}

Sheet solve(const Sparse& q, const std::vector<Role>& role, const Movers& movers) {
    Sheet sheet;
    for (std::uint32_t p = 0; p < role.size(); ++p)
        if (role[p] == Role::free) sheet.free.push_back(p);
    const Sparse to_free = picks(q.rows(), sheet.free), to_held = picks(q.rows(), movers.places);
    const Sparse q_free = to_free.transpose() * q * to_free;
    const Sparse q_between = to_free.transpose() * q * to_held;
    const Sparse q_held = to_held.transpose() * q * to_held;
    sheet.weights = solve_checked(q_free, -Eigen::MatrixXd(q_between), "biharmonic rig");
    sheet.energy = Eigen::MatrixXd(q_held) + q_between.transpose() * sheet.weights;
    return sheet;
}

// Adds the rows of the pockets to those of the sheet.
void carry_pockets(Sheet& sheet, const Mesh& mesh, const Weld& weld, const Movers& movers, const Pockets& pockets) {
    if (pockets.places.empty()) return;
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(std::ssize(weld.vertex), std::ssize(movers.places));
    all(sheet.free, Eigen::all) = sheet.weights;
    for (Eigen::Index m = 0; m < all.cols(); ++m) all(movers.places[static_cast<std::size_t>(m)], m) = 1;
    const Eigen::MatrixXd carried = fill_pockets(mesh, weld, pockets, all);
    const Eigen::Index free = sheet.weights.rows();
    sheet.weights.conservativeResize(free + carried.rows(), Eigen::NoChange);
    sheet.weights.bottomRows(carried.rows()) = carried;
    sheet.free.insert(sheet.free.end(), pockets.places.begin(), pockets.places.end());
}

}  // namespace

SheetSkin sheet_skin(const Face& face, const Weld& weld, const std::vector<bool>& solved, double scale) {
    const std::vector<bool> is_pocket = closed_pockets(face, weld, solved);
    SheetSkin skin{{}, line_pockets(face, weld, solved, is_pocket, scale)};
    skin.solved = skin.pockets.places.empty() ? face.mesh : without_places(face.mesh, weld, is_pocket);
    return skin;
}

Sheet solve_sheet(const Mesh& mesh, const SheetSkin& skin, const Weld& weld, const Movers& movers, double scale,
                  const BiharmonicOptions& options) {
    const std::vector<Role> role = roles(skin.solved, weld, movers, options.far_radius * scale);
    const Sparse q = stiffness(laplacian(skin.solved, weld), options.tension / (scale * scale));
    Sheet sheet = solve(q, role, movers);
    carry_pockets(sheet, mesh, weld, movers, skin.pockets);
    return sheet;
}

}  // namespace mien
