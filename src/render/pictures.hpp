// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "render/model.hpp"

namespace mien {

/// Uploads the pictures that the scene's materials use: colours and emission as sRGB, roughness and normals as they
/// are, each once, with smaller copies for surfaces far away. Fills `pictures` and `pictures_of`. Throws Error if a
/// picture is larger than the driver can take.
void upload_pictures(StillModel& still, const Scene& scene);

/// The colours of a scale, left to right.
GlName scale_picture(ColourScale scale);

}  // namespace mien
