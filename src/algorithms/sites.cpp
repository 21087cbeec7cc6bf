// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The named sites are where MPEG-4's points leave most of the face unknown: throat and neck, under the jaw, the cheek's
// side, the forehead, and the folds beside nose, mouth and lids. Their places are on the sample head of samples/.

#include "algorithms/sites.hpp"

#include <array>
#include <cmath>
#include <string>

#include "algorithms/generic_face.hpp"
#include "algorithms/shape_motions.hpp"

#include "mien/face.hpp"

namespace mien {

namespace {

struct NamedSite {
    std::string_view id, mirror, words;
    Vec3 position;
    double mobility;
};

// The midline and the subject's left; the right mirrors it. Mobility was measured on the ICT face model's expressions,
// beside that of the standard sites.
constexpr std::array<NamedSite, 20> named{{
    {"throat", "throat", "throat, under the chin where it meets the neck", {0, -2.10, -0.45}, 0.34},
    {"neck-front", "neck-front", "front of the neck", {0, -2.65, -0.80}, 0.12},
    {"forehead", "forehead", "middle of the forehead", {0, 1.00, 0.25}, 0.19},
    {"between-brows", "between-brows", "between the brows", {0, 0.42, 0.40}, 0.56},
    {"chin-groove", "chin-groove", "groove between the lower lip and the chin", {0, -1.38, 0.42}, 0.76},
    {"under-jaw-left", "under-jaw-right", "under the jaw, beside the throat", {0.50, -2.15, -0.90}, 0.20},
    {"under-chin-left", "under-chin-right", "under the chin, beside the middle", {0.40, -1.95, -0.50}, 0.31},
    {"jaw-line-left", "jaw-line-right", "jaw line below the corner of the mouth", {0.70, -1.55, -0.30}, 0.55},
    {"jaw-angle-left", "jaw-angle-right", "below the angle of the jaw", {0.75, -1.80, -1.15}, 0.12},
    {"neck-side-left", "neck-side-right", "side of the neck", {0.45, -2.45, -1.00}, 0.14},
    {"cheek-side-left", "cheek-side-right", "cheek before the ear", {0.95, -0.85, -0.55}, 0.20},
    {"nose-fold-left", "nose-fold-right", "fold from the nose to the corner of the mouth", {0.47, -0.70, 0.25}, 0.70},
    {"mouth-fold-left", "mouth-fold-right", "fold below the corner of the mouth", {0.50, -1.33, 0.20}, 0.89},
    {"lid-fold-left", "lid-fold-right", "between the brow and the upper lid", {0.38, 0.28, 0.24}, 1.09},
    {"lid-side-left",
     "lid-side-right",
     "under the tail of the brow, above the outer corner of the eye",
     {0.71, 0.30, 0.16},
     0.71},
    {"eye-side-left",
     "eye-side-right",
     "beside the outer corner of the eye, where it creases",
     {0.85, 0.12, 0.00},
     0.31},
    {"under-eye-left", "under-eye-right", "cheek below the lower lid", {0.42, -0.32, 0.20}, 0.65},
    {"forehead-left", "forehead-right", "side of the forehead, above the brow", {0.55, 0.92, 0.12}, 0.46},
    {"temple-left", "temple-right", "temple, behind the end of the brow", {0.98, 0.30, -0.30}, 0.23},
    {"beside-nose-left", "beside-nose-right", "side of the nose below the eye", {0.28, -0.30, 0.30}, 0.43},
}};

// The standard sites, with their motion from the known expressions.
std::vector<Site> standard_sites() {
    std::vector<Site> sites;
    std::vector<std::string> ids;
    for (const StandardPoint& point : standard_points()) {
        const auto place = generic_position(point.id);
        if (!place || point.id == "3.5" || point.id == "3.6") continue;
        sites.push_back({point.id, point.mirror, point.place, *place, 0});
        ids.emplace_back(point.id);
    }
    // Every expression counts alike, however far it goes.
    for (const std::vector<Vec3>& motion : shape_motions(ids)) {
        double whole = 0;
        for (const Vec3& m : motion) whole += dot(m, m);
        for (std::size_t i = 0; i < sites.size(); ++i) sites[i].mobility += dot(motion[i], motion[i]) / whole;
    }
    for (Site& site : sites) site.mobility = std::sqrt(site.mobility);
    return sites;
}

}  // namespace

std::vector<Site> skin_sites() {
    std::vector<Site> sites = standard_sites();
    for (const NamedSite& site : named) {
        sites.push_back({site.id, site.mirror, site.words, site.position, site.mobility});
        if (site.mirror == site.id) continue;
        const Vec3 other{-site.position.x, site.position.y, site.position.z};
        sites.push_back({site.mirror, site.id, site.words, other, site.mobility});
    }
    return sites;
}

}  // namespace mien
