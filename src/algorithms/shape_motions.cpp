// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "algorithms/shape_motions.hpp"

#include <array>
#include <string_view>

#include "algorithms/arkit_motions.hpp"

namespace mien {

namespace {

constexpr std::array<std::string_view, 25> chosen{
    "browDownLeft",      "browDownRight",   "eyeBlinkLeft",   "eyeBlinkRight",   "eyeLookDownLeft",
    "eyeLookDownRight",  "eyeSquintLeft",   "eyeSquintRight", "jawLeft",         "jawRight",
    "mouthSmileLeft",    "mouthSmileRight", "mouthFrownLeft", "mouthFrownRight", "mouthUpperUpLeft",
    "mouthUpperUpRight", "noseSneerLeft",   "noseSneerRight", "browInnerUp",     "cheekPuff",
    "jawOpen",           "mouthFunnel",     "mouthPucker",    "mouthRollLower",  "mouthShrugLower"};

}  // namespace

std::vector<std::vector<Vec3>> shape_motions(std::span<const std::string> ids) {
    std::vector<std::vector<Vec3>> shapes;
    for (const std::string_view shape : chosen) {
        shapes.emplace_back();
        for (const std::string& id : ids) shapes.back().push_back(arkit_motion(shape, id));
    }
    return shapes;
}

}  // namespace mien
