// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "io/gltf_base.hpp"

namespace mien {

/// The document of a head that came from no glTF: a mesh per number of `Part::mesh`, each of one primitive.
BaseDocument fresh_document(const Mesh& mesh);

}  // namespace mien
