// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "mien/algorithms/reading.hpp"
#include "mien/rig.hpp"

namespace mien {

/// What every rigger understands; a rigger ignores what does not concern it.
struct RigOptions {
    Reading reading = Reading::remedied;
    std::uint32_t influences = 8;  ///< points kept per vertex; 0 keeps all
};

/// A way to make a rig, by name. Command line, Python and studio all read this one table.
struct Rigger {
    std::string_view name;     ///< "biharmonic"
    std::string_view summary;  ///< one line for help texts
    Rig (*rig)(const Face&, const RigOptions&);
};

/// All riggers, the default first.
std::span<const Rigger> riggers();

/// Makes a rig with the rigger called `method`. Throws Error that lists the names if there is none.
Rig make_rig(const Face& face, std::string_view method, const RigOptions& options = {});

}  // namespace mien
