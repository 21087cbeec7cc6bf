// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "algorithms/shape_table.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

#include "algorithms/arkit_motions.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr double upper_lip_of_jaw_open = 0.3;

// Sculptors agree on where a shape goes more than on how far. The table's stands at one end for these: beside an
// artist's set for another head it moved browInnerUp by 0.36 of the way and mouthRollLower by 2.5 times. They get the
// root of what lies between: half way, as ratios go.
struct Strength {
    std::string_view shape;  // without its side
    double factor;
};
constexpr std::array strengths{
    Strength{"browInnerUp", 1.6},     Strength{"mouthPress", 1.5},       Strength{"mouthFrown", 1.3},
    Strength{"eyeWide", 1.15},        Strength{"mouthDimple", 1.15},     Strength{"mouthRollLower", 0.65},
    Strength{"mouthRollUpper", 0.72}, Strength{"mouthShrugLower", 0.73}, Strength{"noseSneer", 0.67},
    Strength{"mouthLeft", 0.8},       Strength{"mouthRight", 0.8},       Strength{"cheekPuff", 0.8}};

double strength_of(std::string_view shape) {
    for (const Strength& strength : strengths)
        if (shape.starts_with(strength.shape)) return strength.factor;
    return 1;
}

bool is_above_the_mouth(std::string_view id) {
    for (const char* lip : {"2.2", "2.6", "2.7", "8.1", "8.5", "8.6", "8.9", "8.10"})
        if (id == lip) return true;
    return id.starts_with("9.");
}

}  // namespace

bool is_driven(std::string_view id) {
    return arkit_neutral(id) && !id.starts_with("6.") && id != "3.5" && id != "3.6" && id != "9.8" && id != "9.9" &&
           id != "9.10" && id != "9.11";
}

Take neutral_take(std::span<const FeaturePoint> points) {
    Take take;
    take.times = {0};
    for (const FeaturePoint& point : points) {
        if (!is_driven(point.id)) continue;
        take.points.push_back(point.id);
        take.samples.push_back(*arkit_neutral(point.id));
    }
    if (take.points.size() < 3)
        throw Error(fmt::format("shapes: expected three or more of the feature points of MPEG-4 on the skin, found {}",
                                take.points.size()));
    return take;
}

std::vector<Vec3> table_motions(std::string_view shape, std::span<const std::string> ids) {
    std::vector<Vec3> motions;
    const double strength = strength_of(shape);
    for (const std::string& id : ids) motions.push_back(strength * arkit_motion(shape, id));
    return motions;
}

std::vector<Vec3> jaw_open_motions(std::span<const std::string> ids) {
    std::vector<Vec3> motions = table_motions("jawOpen", ids);
    for (std::size_t i = 0; i < motions.size(); ++i)
        if (is_above_the_mouth(ids[i])) motions[i] = upper_lip_of_jaw_open * motions[i];
    return motions;
}

}  // namespace mien
