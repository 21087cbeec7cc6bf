// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The feature points of the sample head in samples/, rounded to a hundredth of an eye distance.

#include "algorithms/generic_face.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "mien/face.hpp"

namespace mien {

namespace {

// The midline and the subject's left; the right mirrors it.
constexpr std::array<std::pair<std::string_view, Vec3>, 34> places{{
    {"2.1", {0, -1.80, 0.29}},    {"2.2", {0, -1.06, 0.50}},     {"2.3", {0, -1.07, 0.50}},
    {"2.4", {0.40, -1.07, 0.26}}, {"2.6", {0.19, -1.06, 0.45}},  {"2.8", {0.19, -1.07, 0.45}},
    {"2.10", {0, -1.60, 0.39}},   {"2.11", {0.36, -1.75, 0.11}}, {"2.13", {0.84, -1.46, -0.84}},
    {"3.1", {0.51, 0.10, 0.13}},  {"3.3", {0.51, -0.08, 0.13}},  {"3.5", {0.51, 0.01, 0.08}},
    {"3.7", {0.74, 0.02, -0.04}}, {"3.9", {0.51, -0.17, 0.10}},  {"3.11", {0.26, -0.02, 0.04}},
    {"3.13", {0.51, 0.18, 0.11}}, {"4.1", {0.26, 0.45, 0.35}},   {"4.3", {0.59, 0.49, 0.20}},
    {"4.5", {0.82, 0.45, 0.01}},  {"5.1", {0.75, -1.05, 0.02}},  {"5.3", {0.69, -0.44, 0.08}},
    {"8.1", {0, -0.94, 0.53}},    {"8.2", {0, -1.23, 0.48}},     {"8.3", {0.42, -1.07, 0.27}},
    {"8.5", {0.21, -0.96, 0.49}}, {"8.7", {0.20, -1.21, 0.44}},  {"8.10", {0.08, -0.92, 0.54}},
    {"9.1", {0.29, -0.56, 0.41}}, {"9.3", {0, -0.51, 0.74}},     {"9.5", {0.22, -0.69, 0.39}},
    {"9.7", {0.13, -0.05, 0.28}}, {"9.12", {0, -0.27, 0.53}},    {"9.13", {0.15, -0.28, 0.39}},
    {"9.15", {0, -0.70, 0.49}},
}};

std::optional<Vec3> listed(std::string_view id) {
    const auto found = std::find_if(places.begin(), places.end(), [&](const auto& place) { return place.first == id; });
    if (found == places.end()) return std::nullopt;
    return found->second;
}

}  // namespace

std::optional<Vec3> generic_position(std::string_view id) {
    if (const auto here = listed(id)) return here;
    const auto there = listed(mirror_point(id));
    if (!there) return std::nullopt;
    return Vec3{-there->x, there->y, there->z};
}

}  // namespace mien
