// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/play_faps.hpp"

#include <bitset>
#include <optional>

#include "mien/algorithms/complete.hpp"
#include "mien/algorithms/faps.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

constexpr int jaw_and_lips = 2, tongue = 6, outer_lips = 8;  // groups

// The lips' two contours, the jaw, the chin and the tongue move together, whichever of them is sent.
std::size_t part_of(const Fap& fap) {
    return static_cast<std::size_t>(fap.group == outer_lips || fap.group == tongue ? jaw_and_lips : fap.group);
}

void set(Axes& axes, FapAxis axis) {
    axes.x = axes.x || axis == FapAxis::x;
    axes.y = axes.y || axis == FapAxis::y;
    axes.z = axes.z || axis == FapAxis::z;
}

// What a stream ever sends.
struct Sent {
    FapMask faps;
    std::bitset<11> parts;
    bool of_tongue = false;
    Axes carrying{false, false, false};  // of the jaw's turns and shifts, and of lips that are pushed

    explicit Sent(const FapStream& stream) {
        for (const FapFrame& frame : stream.frames) faps |= frame.mask;
        for (std::size_t i = 0; i < fap_count; ++i)
            if (faps[i]) {
                parts.set(part_of(mien::faps[i]));
                of_tongue = of_tongue || mien::faps[i].group == tongue;
            }
        for (const int fap : {3, 14, 15, 16, 17})
            if (faps[fap_index(fap)]) set(carrying, fap_info(fap).axis);
    }
};

// The axes along which the place of a point is told, if it is told at all.
std::optional<Axes> told_axes(const Sent& sent, const std::string& point) {
    if (point.starts_with("6.") && sent.of_tongue) return Axes{};
    bool is_told = false, is_of_mouth = false;
    Axes told{false, false, false};
    for (std::size_t i = 0; i < fap_count; ++i) {
        if (faps[i].point != point) continue;
        is_told = is_told || sent.faps[i] || !sent.parts[part_of(faps[i])];
        is_of_mouth = is_of_mouth || part_of(faps[i]) == jaw_and_lips;
        if (sent.faps[i]) set(told, faps[i].axis);
    }
    if (!is_told) return std::nullopt;
    if (!is_of_mouth) return Axes{};
    return Axes{told.x || !sent.carrying.x, told.y || !sent.carrying.y, told.z || !sent.carrying.z};
}

}  // namespace

std::vector<ToldPoint> told_points(const FapStream& stream, const Fapu& fapu) {
    const Sent sent(stream);
    std::vector<ToldPoint> told;
    for (const FeaturePoint& point : fapu.points)
        if (const auto axes = told_axes(sent, point.id)) told.push_back({point.id, *axes});
    return told;
}

Take play_faps(const Face& face, const FapStream& stream, const Fapu& fapu) {
    Face told{face.mesh, face.points};
    std::vector<Rename> names;
    for (const ToldPoint& point : told_points(stream, fapu)) {
        const auto i = find_point(told.points, point.id);
        if (!i) continue;
        names.push_back({point.id, point.id});
        Axes& moves = told.points[*i].moves;
        moves = {moves.x && point.axes.x, moves.y && point.axes.y, moves.z && point.axes.z};
    }
    if (names.empty()) throw Error("play: expected parameters that move a point of the face, found none");
    return complete(told, rename_points(to_take(stream, fapu), names));
}

}  // namespace mien
