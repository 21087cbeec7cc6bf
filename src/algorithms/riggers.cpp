// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The one table of methods that every front reads.

#include "mien/algorithms/riggers.hpp"

#include <array>
#include <fmt/format.h>
#include <string>

#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/algorithms/rig_ellipsoid.hpp"
#include "mien/algorithms/rig_rbf.hpp"
#include "mien/algorithms/rig_surface_distance.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::array table{
    Rigger{"biharmonic", "the skin bends like a thin elastic sheet that the points hold",
           [](const Face& face, const RigOptions& options) {
               return rig_biharmonic(face, {.influences = options.influences});
           }},
    Rigger{"surface-distance", "points move what is near them along the surface (Kshirsagar et al.)",
           [](const Face& face, const RigOptions& options) {
               return rig_surface_distance(face, {.reading = options.reading});
           }},
    Rigger{
        "ellipsoid", "points move what lies in an ellipsoid round them (Dutreve et al.)",
        [](const Face& face, const RigOptions& options) { return rig_ellipsoid(face, {.reading = options.reading}); }},
    Rigger{"rbf", "points are interpolated through space, straight across mouth and lids",
           [](const Face& face, const RigOptions& options) {
               return rig_rbf(face, {RbfRigOptions::Kernel::linear, options.influences});
           }},
    Rigger{"rbf-surface", "points are interpolated along the surface and fade with the way",
           [](const Face& face, const RigOptions& options) {
               return rig_rbf(face, {RbfRigOptions::Kernel::surface, options.influences});
           }},
};

}  // namespace

std::span<const Rigger> riggers() {
    return table;
}

Rig make_rig(const Face& face, std::string_view method, const RigOptions& options) {
    std::string names;
    for (const Rigger& rigger : riggers()) {
        if (rigger.name == method) return rigger.rig(face, options);
        names += (names.empty() ? "" : ", ") + std::string(rigger.name);
    }
    throw Error(fmt::format("expected a rigging method ({}), found \"{}\"", names, method));
}

}  // namespace mien
