// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mien/vec.hpp"

namespace mien {

/// Red, green and blue, 0 to 1: sRGB where nothing else is said.
using Rgb = std::array<float, 3>;

/// A lamp far away with a flat, square face: a soft box in a photographer's studio.
struct Light {
    /// From the subject to the lamp, as the camera sees it: +x to the right of the picture, +y upwards in the world,
    /// +z towards the camera. The studio turns with the camera, so every view is lit alike. Need not be of length 1.
    Vec3 direction{0, 0, 1};
    Rgb colour{1, 1, 1};    ///< linear; 1 lights a white surface that faces the lamp to white before tone mapping
    double half_size = 12;  ///< degrees from the lamp's middle to its edge, 0 to 45: larger is softer
};

/// A small ball that marks a place: a feature point, a captured marker.
struct Mark {
    Vec3 position;
    double radius = 4;  ///< pixels
    Rgb colour{1, 0.3F, 0};
    bool always_on_top = false;  ///< drawn even where a surface lies before it
};

enum class Quality {
    draft,  ///< one pass, plain light without shadows, four samples a pixel: for moving pictures on the processor
    full,   ///< many passes, each with another place on a lamp and its shadow: soft shadows, light under the skin
};

/// How a picture is lit and drawn.
struct Look {
    Quality quality = Quality::full;
    std::uint32_t passes = 48;  ///< of `full`, 8 to 1024: more is smoother and takes longer in proportion
    std::vector<Light> lights;  ///< empty: three, as a portrait has them: key, fill, rim
    Rgb sky{0.31F, 0.32F, 0.34F}, ground{0.13F, 0.115F, 0.105F};  ///< linear light from above and below
    double exposure = 1;                                          ///< times all light
    Rgb top{0.80F, 0.81F, 0.83F}, bottom{0.52F, 0.54F, 0.57F};    ///< background
    bool transparent = false;                                     ///< no background: alpha 0 where nothing is drawn
    bool wire = false;                                            ///< the edges of the triangles over the surfaces
    std::vector<Mark> marks;
};

}  // namespace mien
