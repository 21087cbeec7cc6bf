// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What the extension MIEN_rig holds (docs/rig-file.md), in parts: the rig, what it knows from example shapes, and the
// polygons of a head that did not come from glTF.

#pragma once

#include <nlohmann/json.hpp>

#include "io/glb.hpp"

#include "mien/mesh.hpp"
#include "mien/rig.hpp"

namespace mien {

/// Appends the numbers of the rig to the document and returns the extension's members that describe it.
nlohmann::json append_rig(GltfDocument& document, const Rig& rig);

/// The rig that the extension describes. Throws Error naming the JSON pointer, expected and found unless everything in
/// it fits together.
Rig read_rig_extension(const GltfDocument& document, const nlohmann::json& extension);

/// The same for the member "prior" of a rig that has one. `rig`: what was read of it so far.
nlohmann::json append_prior(GltfDocument& document, const Prior& prior);
Prior read_prior(const GltfDocument& document, const nlohmann::json& written, const Rig& rig);

/// Appends the faces of a head and returns the member "head". Its vertices are the rig's rest.
nlohmann::json append_head(GltfDocument& document, const Mesh& mesh);

/// The head that `head` describes, with these vertices; the same checks.
Mesh read_head(const GltfDocument& document, const nlohmann::json& head, const std::vector<Vec3f>& rest);

/// Takes the extension out of a document. The lists that it names stay in the buffer.
void drop_rig_extension(nlohmann::json& root);

/// Where errors of the extension are.
inline constexpr const char* rig_pointer = "/extensions/MIEN_rig";

}  // namespace mien
