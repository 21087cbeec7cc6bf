// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The feature points of ISO/IEC 14496-2, Annex C, with their places in our own words.

#include <algorithm>
#include <array>

#include "mien/face.hpp"

namespace mien {

namespace {

constexpr std::array<StandardPoint, 84> table{{
    {"2.1", Side::middle, "2.1", "bottom of the chin"},
    {"2.2", Side::middle, "2.2", "middle point of the inner upper lip contour"},
    {"2.3", Side::middle, "2.3", "middle point of the inner lower lip contour"},
    {"2.4", Side::left, "2.5", "left corner of the inner lip contour"},
    {"2.5", Side::right, "2.4", "right corner of the inner lip contour"},
    {"2.6", Side::left, "2.7", "midpoint between 2.2 and 2.4 on the inner upper lip contour"},
    {"2.7", Side::right, "2.6", "midpoint between 2.2 and 2.5 on the inner upper lip contour"},
    {"2.8", Side::left, "2.9", "midpoint between 2.3 and 2.4 on the inner lower lip contour"},
    {"2.9", Side::right, "2.8", "midpoint between 2.3 and 2.5 on the inner lower lip contour"},
    {"2.10", Side::middle, "2.10", "chin boss"},
    {"2.11", Side::left, "2.12", "left corner of the chin"},
    {"2.12", Side::right, "2.11", "right corner of the chin"},
    {"2.13", Side::left, "2.14", "left corner of the jaw bone"},
    {"2.14", Side::right, "2.13", "right corner of the jaw bone"},
    {"3.1", Side::left, "3.2", "centre of the upper inner left eyelid"},
    {"3.2", Side::right, "3.1", "centre of the upper inner right eyelid"},
    {"3.3", Side::left, "3.4", "centre of the lower inner left eyelid"},
    {"3.4", Side::right, "3.3", "centre of the lower inner right eyelid"},
    {"3.5", Side::left, "3.6", "centre of the pupil of the left eye"},
    {"3.6", Side::right, "3.5", "centre of the pupil of the right eye"},
    {"3.7", Side::left, "3.12", "left corner of the left eye (outer corner)"},
    {"3.8", Side::right, "3.11", "left corner of the right eye (inner corner)"},
    {"3.9", Side::left, "3.10", "centre of the lower outer left eyelid"},
    {"3.10", Side::right, "3.9", "centre of the lower outer right eyelid"},
    {"3.11", Side::left, "3.8", "right corner of the left eye (inner corner)"},
    {"3.12", Side::right, "3.7", "right corner of the right eye (outer corner)"},
    {"3.13", Side::left, "3.14", "centre of the upper outer left eyelid"},
    {"3.14", Side::right, "3.13", "centre of the upper outer right eyelid"},
    {"4.1", Side::left, "4.2", "right corner of the left eyebrow (inner end)"},
    {"4.2", Side::right, "4.1", "left corner of the right eyebrow (inner end)"},
    {"4.3", Side::left, "4.4", "uppermost point of the left eyebrow"},
    {"4.4", Side::right, "4.3", "uppermost point of the right eyebrow"},
    {"4.5", Side::left, "4.6", "left corner of the left eyebrow (outer end)"},
    {"4.6", Side::right, "4.5", "right corner of the right eyebrow (outer end)"},
    {"5.1", Side::left, "5.2", "centre of the left cheek"},
    {"5.2", Side::right, "5.1", "centre of the right cheek"},
    {"5.3", Side::left, "5.4", "left cheek bone"},
    {"5.4", Side::right, "5.3", "right cheek bone"},
    {"6.1", Side::middle, "6.1", "tip of the tongue"},
    {"6.2", Side::middle, "6.2", "centre of the tongue body"},
    {"6.3", Side::left, "6.4", "left border of the tongue"},
    {"6.4", Side::right, "6.3", "right border of the tongue"},
    {"7.1", Side::middle, "7.1", "top of the spine: centre of head rotation"},
    {"8.1", Side::middle, "8.1", "middle point of the outer upper lip contour"},
    {"8.2", Side::middle, "8.2", "middle point of the outer lower lip contour"},
    {"8.3", Side::left, "8.4", "left corner of the outer lip contour"},
    {"8.4", Side::right, "8.3", "right corner of the outer lip contour"},
    {"8.5", Side::left, "8.6", "midpoint between 8.3 and 8.1 on the outer upper lip contour"},
    {"8.6", Side::right, "8.5", "midpoint between 8.4 and 8.1 on the outer upper lip contour"},
    {"8.7", Side::left, "8.8", "midpoint between 8.3 and 8.2 on the outer lower lip contour"},
    {"8.8", Side::right, "8.7", "midpoint between 8.4 and 8.2 on the outer lower lip contour"},
    {"8.9", Side::right, "8.10", "right high point of the Cupid's bow"},
    {"8.10", Side::left, "8.9", "left high point of the Cupid's bow"},
    {"9.1", Side::left, "9.2", "left nostril border"},
    {"9.2", Side::right, "9.1", "right nostril border"},
    {"9.3", Side::middle, "9.3", "nose tip"},
    {"9.4", Side::right, "9.5", "bottom right edge of the nose"},
    {"9.5", Side::left, "9.4", "bottom left edge of the nose"},
    {"9.6", Side::right, "9.7", "right upper edge of the nose bone"},
    {"9.7", Side::left, "9.6", "left upper edge of the nose bone"},
    {"9.8", Side::middle, "9.8", "top of the upper teeth"},
    {"9.9", Side::middle, "9.9", "bottom of the lower teeth"},
    {"9.10", Side::middle, "9.10", "bottom of the upper teeth"},
    {"9.11", Side::middle, "9.11", "top of the lower teeth"},
    {"9.12", Side::middle, "9.12", "middle lower edge of the nose bone (or the nose bump)"},
    {"9.13", Side::left, "9.14", "left lower edge of the nose bone"},
    {"9.14", Side::right, "9.13", "right lower edge of the nose bone"},
    {"9.15", Side::middle, "9.15", "bottom middle edge of the nose"},
    {"10.1", Side::left, "10.2", "top of the left ear"},
    {"10.2", Side::right, "10.1", "top of the right ear"},
    {"10.3", Side::left, "10.4", "back of the left ear"},
    {"10.4", Side::right, "10.3", "back of the right ear"},
    {"10.5", Side::left, "10.6", "bottom of the left ear lobe"},
    {"10.6", Side::right, "10.5", "bottom of the right ear lobe"},
    {"10.7", Side::left, "10.8", "lower contact point between left ear lobe and face"},
    {"10.8", Side::right, "10.7", "lower contact point between right ear lobe and face"},
    {"10.9", Side::left, "10.10", "upper contact point between left ear and face"},
    {"10.10", Side::right, "10.9", "upper contact point between right ear and face"},
    {"11.1", Side::middle, "11.1", "middle border between hair and forehead"},
    {"11.2", Side::right, "11.3", "right border between hair and forehead"},
    {"11.3", Side::left, "11.2", "left border between hair and forehead"},
    {"11.4", Side::middle, "11.4", "top of the skull"},
    {"11.5", Side::middle, "11.5", "hair thickness over 11.4"},
    {"11.6", Side::middle, "11.6", "back of the skull"},
}};

}  // namespace

std::span<const StandardPoint> standard_points() {
    return table;
}

std::string_view mirror_point(std::string_view id) {
    const auto found = std::find_if(table.begin(), table.end(), [&](const StandardPoint& p) { return p.id == id; });
    return found == table.end() ? std::string_view{} : found->mirror;
}

}  // namespace mien
