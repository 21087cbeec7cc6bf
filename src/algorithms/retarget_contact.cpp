// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Contact of lids and lips in retargeting. One linear map per point gives a lid its own share of the way; on an eye
// that opens wider than the performer's a gap is left when the performer's eye is closed. So each pair of points that
// can meet gets the target's opening from the source's opening, and what the maps gave is corrected to it.
//
// With w the source's upper less its lower point, w0 the same at rest, W0 the target's at rest, all in eye distances, n
// and N the directions of opening (lids: along w0 and W0; lips: up), o = w.n, o0 = w0.n, T0 = W0.N, h = o - o0, A the
// mean of the two points' maps and g = N.A n:
//
//     f(h) = T0 + r h                                  h <= 0
//     f(h) = T0 + g h + (r - g) L (1 - exp(-h / L))    h > 0
//
// closes with slope r, opens with slope g and has one slope at rest. For lids r = T0 / o0: the share of the opening
// that is left is the same on both faces. For lips it depends on which mouths are open at rest. Below the floor the
// opening levels out over a width of 2 q, and what that takes from the opening at rest is given back, so that rest is
// at rest.
//
// The rest of w is carried by A, less its part along N. The difference between wanted and given is shared: by the lids
// in proportion to how far each moved, by the lips half and half, and fading where the mouth is wide open.
//
// A source without lower lids gets a still partner at the usual distance below each upper lid. How open its own eye is
// can only be guessed so.

#include "algorithms/retarget_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string_view>

#include "mien/error.hpp"

namespace mien {

namespace {

using Kind = ContactPair::Kind;

// All in eye distances.
constexpr double open_mouth = 0.04;    // a mouth more open than that at rest is open
constexpr double lip_bend = 0.02;      // L of lips
constexpr double level_width = 0.002;  // q
constexpr double wide_open = 0.15;     // there lips have half their correction
constexpr double lid_motion = 0.02;    // below that, lids share alike

struct Candidate {
    Kind kind;
    std::string_view upper, lower, fold_above, fold_below;
};
constexpr std::array<Candidate, 8> candidates{{{Kind::lids, "3.1", "3.3", "3.13", "3.9"},
                                               {Kind::lids, "3.2", "3.4", "3.14", "3.10"},
                                               {Kind::inner_lips, "2.2", "2.3", "", ""},
                                               {Kind::inner_lips, "2.6", "2.8", "", ""},
                                               {Kind::inner_lips, "2.7", "2.9", "", ""},
                                               {Kind::outer_lips, "8.1", "8.2", "", ""},
                                               {Kind::outer_lips, "8.5", "8.7", "", ""},
                                               {Kind::outer_lips, "8.6", "8.8", "", ""}}};

std::size_t index_of(const Retarget& map, std::string_view id) {
    const auto found = std::find(map.points.begin(), map.points.end(), id);
    return found == map.points.end() ? no_point : static_cast<std::size_t>(found - map.points.begin());
}

// p through the linear map of point i, in the unit of the target.
Vec3 through(const Retarget& map, std::size_t i, const Vec3& d) noexcept {
    return d.x * map.local[i][0] + d.y * map.local[i][1] + (map.planar ? 0 : d.z) * map.local[i][2];
}

// The mean of the pair's two maps.
Vec3 through(const Retarget& map, const ContactPair& pair, const Vec3& d) noexcept {
    if (pair.lower == no_point) return through(map, pair.upper, d);
    return 0.5 * (through(map, pair.upper, d) + through(map, pair.lower, d));
}

// From the lower lid to the upper on most faces, about 10 mm of 63 mm, in the coordinates of a face.
Vec3 usual_opening(const FaceFrame& frame) {
    return frame.eyes * rotate(frame.turn, {0, 0.165, 0.02});
}

void set_rest(const Retarget& map, const FaceFrames& frames, std::span<const FeaturePoint> face,
              const Candidate& candidate, ContactPair& pair) {
    if (pair.lower != no_point) {
        pair.source_rest = map.source_neutral[pair.upper] - map.source_neutral[pair.lower];
        pair.target_rest = map.target_neutral[pair.upper] - map.target_neutral[pair.lower];
        return;
    }
    pair.source_rest = usual_opening(frames.source);
    if (map.planar) pair.source_rest.z = 0;
    const std::optional<std::size_t> lower = find_point(face, candidate.lower);
    pair.target_rest = lower ? map.target_neutral[pair.upper] - face[*lower].position : usual_opening(frames.target);
}

void set_directions(const FaceFrames& frames, ContactPair& pair) {
    if (pair.kind == Kind::lids) {
        pair.source_up = pair.source_rest / length(pair.source_rest);
        pair.target_up = pair.target_rest / length(pair.target_rest);
    } else {
        pair.source_up = rotate(frames.source.turn, {0, 1, 0});
        pair.target_up = rotate(frames.target.turn, {0, 1, 0});
    }
    pair.source_opening = dot(pair.source_rest, pair.source_up) / frames.source.eyes;
    pair.target_opening = dot(pair.target_rest, pair.target_up) / frames.target.eyes;
}

// r, for the target's opening T0 at rest.
double closing_slope(const ContactPair& pair, double T0) {
    const double o0 = pair.source_opening, g = pair.opening;
    switch (pair.kind) {
        case Kind::lids:
            return T0 / o0;
        case Kind::inner_lips:
            if (o0 <= open_mouth) return g;
            return T0 > open_mouth ? T0 / o0 : std::max(g, T0 / o0);
        case Kind::outer_lips:
            return o0 > 0 ? std::clamp(T0 / o0, g / 2, 2 * g) : g;
    }
    return g;
}

void set_slopes(const Retarget& map, ContactPair& pair) {
    const double scale = map.source_eyes / map.target_eyes;
    pair.opening = scale * dot(pair.target_up, through(map, pair, pair.source_up));
    pair.bend = pair.kind == Kind::lids ? pair.source_opening : lip_bend;
    pair.closing = closing_slope(pair, pair.target_opening);
    pair.closed = pair.kind == Kind::inner_lips ? std::min(0.0, pair.target_opening) : 0;
}

bool can_close(const ContactPair& pair) {
    return pair.opening > 0 && std::isfinite(pair.closing) && is_finite(pair.source_up) && is_finite(pair.target_up);
}

// The user's opening of a sealed mouth: what a mouth that closes comes to, or, where the performer's is closed at rest,
// what rest comes to.
void seal(ContactPair& pair, double opening) {
    pair.closed = std::min(pair.closed, opening);
    if (pair.kind == Kind::lids || pair.source_opening > open_mouth)
        pair.closing = (pair.target_opening - opening) / pair.source_opening;
    else
        pair.target_opening = opening;
}

std::optional<ContactPair> fitted(const Retarget& map, const FaceFrames& frames, std::span<const FeaturePoint> face,
                                  const Candidate& candidate) {
    ContactPair pair;
    pair.kind = candidate.kind;
    pair.upper = index_of(map, candidate.upper);
    pair.lower = index_of(map, candidate.lower);
    const bool lids = pair.kind == Kind::lids;
    if (pair.upper == no_point || (!lids && pair.lower == no_point)) return std::nullopt;
    if (!frames.known && !(lids && pair.lower != no_point)) return std::nullopt;
    set_rest(map, frames, face, candidate, pair);
    set_directions(frames, pair);
    set_slopes(map, pair);
    return can_close(pair) ? std::optional(pair) : std::nullopt;
}

}  // namespace

void fit_contact(Retarget& map, const FaceFrames& frames, std::span<const FeaturePoint> face,
                 std::span<const SealedOpening> sealed) {
    map.source_eyes = frames.source.eyes;
    map.target_eyes = frames.target.eyes;
    for (const Candidate& candidate : candidates) {
        std::optional<ContactPair> pair = fitted(map, frames, face, candidate);
        if (!pair) continue;
        pair->fold_above = index_of(map, candidate.fold_above);
        pair->fold_below = index_of(map, candidate.fold_below);
        map.pairs.push_back(*pair);
    }
    for (const SealedOpening& one : sealed) {
        const auto named = [&](const ContactPair& pair) { return map.points[pair.upper] == one.upper; };
        const auto pair = std::find_if(map.pairs.begin(), map.pairs.end(), named);
        if (pair == map.pairs.end())
            throw Error(fmt::format(
                "retarget: expected the upper point of a pair of lids or lips that take and face share, found {}",
                one.upper));
        seal(*pair, one.opening);
    }
}

namespace {

// x where it is well above 0, 0 where it is well below, and one slope throughout.
double levelled(double x) noexcept {
    if (x >= level_width) return x;
    if (x <= -level_width) return 0;
    return (x + level_width) * (x + level_width) / (4 * level_width);
}

// The target's opening for the source's opening above rest, in eye distances.
double opening(const ContactPair& pair, double h) noexcept {
    const double g = pair.opening, r = pair.closing, L = pair.bend;
    const double f = pair.target_opening + (h <= 0 ? r * h : g * h + (r - g) * L * -std::expm1(-h / L));
    const double at_rest = levelled(pair.target_opening - pair.closed);
    return levelled(f - pair.closed) - at_rest + pair.target_opening;
}

// The upper lid's share of the correction: the lid that moved takes it.
double upper_share(const Retarget& map, const ContactPair& pair, const Vec3& upper, const Vec3& lower) noexcept {
    if (pair.lower == no_point) return 1;
    if (pair.kind != Kind::lids) return 0.5;
    const double still = lid_motion * lid_motion * map.target_eyes * map.target_eyes;
    const double a = dot(upper, upper) + still, b = dot(lower, lower) + still;
    return a / (a + b);
}

// How much of the sideways motion is carried. A guessed partner lies a little aside of the true one: where the lids
// meet, what seems to be slip is that.
double slip(const ContactPair& pair, double h) noexcept {
    return pair.lower == no_point ? std::clamp(1 + h / pair.source_opening, 0.0, 1.0) : 1;
}

void correct(const Retarget& map, const ContactPair& pair, std::span<const Vec3> source,
             std::span<Vec3> moved) noexcept {
    const Vec3 upper = moved[pair.upper], lower = pair.lower == no_point ? Vec3{} : moved[pair.lower];
    Vec3 way = source[pair.upper] - map.source_neutral[pair.upper];
    if (pair.lower != no_point) way -= source[pair.lower] - map.source_neutral[pair.lower];
    if (!is_finite(way)) return;

    const Vec3 &n = pair.source_up, &N = pair.target_up;
    const double h = dot(way, n) / map.source_eyes;
    Vec3 beside = pair.target_rest + slip(pair, h) * through(map, pair, way - dot(way, n) * n);
    beside -= dot(beside, N) * N;
    const Vec3 wanted = beside + map.target_eyes * opening(pair, h) * N;
    Vec3 correction = wanted - (pair.target_rest + upper - lower);
    if (pair.kind != Kind::lids) {
        const double open = std::max(h, 0.0) / wide_open;
        correction = correction / (1 + open * open);
    }
    const double share = upper_share(map, pair, upper, lower);
    moved[pair.upper] += share * correction;
    if (pair.lower != no_point) moved[pair.lower] -= (1 - share) * correction;
    if (pair.fold_above != no_point) moved[pair.fold_above] += share / 2 * correction;
    if (pair.fold_below != no_point) moved[pair.fold_below] -= (1 - share) / 2 * correction;
}

}  // namespace

void keep_contact(const Retarget& map, std::span<const Vec3> source, std::span<Vec3> moved) noexcept {
    for (const ContactPair& pair : map.pairs) correct(map, pair, source, moved);
}

}  // namespace mien
