// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Every action is a set of displacements per marker (millimetres, left side; mirrored to the right) times a keyed
// curve. Sizes are those of ordinary expressions: jaw 32 mm, lid down to its partner, corners of a smile 12 mm, brows 8
// mm.

#include "performance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace mien::samples {
namespace {

constexpr double rate = 60, seconds = 8;

struct Marker {
    const char* name;
    const char* id;
};
constexpr Marker markers[]{
    {"HeadTop", "11.4"},     {"HeadL", "11.3"},       {"HeadR", "11.2"},     {"LBrowInner", "4.1"},
    {"RBrowInner", "4.2"},   {"LBrowMid", "4.3"},     {"RBrowMid", "4.4"},   {"LBrowOuter", "4.5"},
    {"RBrowOuter", "4.6"},   {"LLidUp", "3.1"},       {"RLidUp", "3.2"},     {"LLidLow", "3.3"},
    {"RLidLow", "3.4"},      {"NoseBridge", "9.12"},  {"NoseTip", "9.3"},    {"LNostril", "9.1"},
    {"RNostril", "9.2"},     {"LCheekBone", "5.3"},   {"RCheekBone", "5.4"}, {"LCheek", "5.1"},
    {"RCheek", "5.2"},       {"LipUpMid", "8.1"},     {"LLipUp", "8.5"},     {"RLipUp", "8.6"},
    {"LMouthCorner", "8.3"}, {"RMouthCorner", "8.4"}, {"LLipLow", "8.7"},    {"RLipLow", "8.8"},
    {"LipLowMid", "8.2"},    {"ChinBoss", "2.10"},    {"ChinMid", "2.1"},    {"LChin", "2.11"},
    {"RChin", "2.12"},
};

// Time and value; between keys the value moves with zero speed at both ends (minimum jerk, Flash and Hogan 1985).
struct Key {
    double time, value;
};

double at(std::span<const Key> keys, double time) {
    if (time <= keys.front().time) return keys.front().value;
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
        const Key &a = keys[i], &b = keys[i + 1];
        if (time >= b.time) continue;
        const double s = (time - a.time) / (b.time - a.time);
        return a.value + (b.value - a.value) * s * s * s * (10 + s * (6 * s - 15));
    }
    return keys.back().value;
}

struct Displacement {
    const char* id;  // of the left point or a midline point
    Vec3 mm;
};

struct Action {
    std::vector<Key> keys;
    std::vector<Displacement> moves;
};

// clang-format off
const std::vector<Action>& actions() {
    static const std::vector<Action> list{
        // brows up
        {{{.45, 0}, {.75, 1}, {1.1, 1}, {1.4, 0}},
         {{"4.1", {0, 7, .5}}, {"4.3", {.3, 8.5, 0}}, {"4.5", {.5, 5.5, -1}}, {"3.1", {0, .9, .1}}}},
        // frown
        {{{1.75, 0}, {2.05, 1}, {2.35, 1}, {2.65, 0}},
         {{"4.1", {-4.5, -3, 1}}, {"4.3", {-2, -3.6, 1}}, {"4.5", {-.5, -1.2, .2}}, {"5.3", {0, .8, .2}}, {"3.3", {0, .6, .1}}, {"9.12", {0, .4, .4}}}},
        // smile
        {{{2.7, 0}, {3.05, 1}, {3.55, .95}, {3.9, 0}},
         {{"8.3", {9, 7.5, -5}}, {"8.5", {3.6, 4.4, -2.4}}, {"8.1", {0, 2.4, -2}}, {"8.7", {3.2, -.6, -2.8}}, {"8.2", {0, -2.6, -2}}, {"5.1", {2, 4.5, 2.2}},
          {"5.3", {.5, 3.5, 1.6}}, {"3.3", {0, 1.3, .3}}, {"4.5", {0, -.8, 0}}, {"9.1", {1.4, .6, -.4}}, {"2.10", {0, -1.4, -.8}}}},
        // jaw
        {{{3.95, 0}, {4.35, 1}, {4.6, 1}, {5, 0}, {5.95, 0}, {6.05, .38}, {6.1, .38}, {6.22, 0}, {6.26, 0}, {6.38, .4}, {6.46, .38}, {6.6, .13}, {6.85, .12},
          {6.95, .02}, {7, .02}, {7.12, .5}, {7.22, .5}, {7.5, 0}},
         {{"2.1", {0, -32, -10}}, {"2.10", {0, -31, -8.5}}, {"2.11", {0, -29, -10}}, {"8.2", {0, -27, -6.5}}, {"8.7", {-1.2, -22, -6.5}},
          {"8.3", {-2.5, -9.5, -4}}, {"8.5", {-.8, -.2, -.4}}, {"8.1", {0, 1.1, .3}}, {"5.1", {-1.5, -5, -1.6}}}},
        // pucker, and the rounding of "oo"
        {{{5, 0}, {5.25, 1}, {5.5, 1}, {5.8, 0}, {6.45, 0}, {6.62, .8}, {6.78, .8}, {6.92, 0}},
         {{"8.3", {-8, 0, 4}}, {"8.5", {-2.6, -.2, 6}}, {"8.1", {0, -.3, 6.4}}, {"8.7", {-2.6, .3, 5.8}}, {"8.2", {0, .4, 6}}, {"5.1", {-2, 0, 1}},
          {"2.10", {0, 1.2, 1}}, {"9.1", {-.5, -.3, .2}}}},
        // lips pressed: "m"
        {{{5.8, 0}, {5.9, 1}, {5.97, 1}, {6.05, 0}, {6.12, 0}, {6.22, 1}, {6.28, 1}, {6.36, 0}},
         {{"8.1", {0, -1.4, -1.4}}, {"8.5", {0, -1.1, -1.2}}, {"8.2", {0, 2, -1.6}}, {"8.7", {0, 1.6, -1.4}}, {"8.3", {.8, .2, -.6}}, {"2.10", {0, .9, .3}}}},
        // lower lip to the upper teeth: "f"
        {{{6.84, 0}, {6.94, 1}, {7.02, 1}, {7.12, 0}},
         {{"8.2", {0, 3.6, -3.4}}, {"8.7", {0, 2.6, -2.6}}, {"8.1", {0, 1.4, .4}}, {"8.5", {0, 1, .3}}, {"2.10", {0, 1, -.4}}}},
    };
    return list;
}
// clang-format on

// Lids shut in 100 ms and open in 200 ms. A squint of a smile must not push the lids past each other, so a blink is a
// share of whatever gap is left.
constexpr std::array<Key, 12> blink{{{1.42, 0},
                                     {1.52, 1},
                                     {1.56, 1},
                                     {1.78, 0},
                                     {3.25, 0},
                                     {3.35, 1},
                                     {3.4, 1},
                                     {3.62, 0},
                                     {7.2, 0},
                                     {7.3, 1},
                                     {7.34, 1},
                                     {7.56, 0}}};

// Degrees about +x, +y, +z and millimetres.
constexpr std::array<Key, 7> nod{{{.3, 0}, {1, -5}, {1.8, 3}, {3, -4}, {4.4, -7}, {5.6, 4}, {7.6, 0}}};
constexpr std::array<Key, 6> turn{{{.3, 0}, {1.4, 9}, {2.8, 2}, {4.2, -9.5}, {5.8, -3}, {7.7, 0}}};
constexpr std::array<Key, 5> tilt{{{.4, 0}, {2.2, 3.5}, {4, -2.5}, {6, 3}, {7.7, 0}}};
constexpr std::array<Key, 5> sway{{{.3, 0}, {2, 14}, {4.5, -11}, {6.5, 6}, {7.8, 0}}};
constexpr std::array<Key, 5> lean{{{.3, 0}, {1.8, -6}, {4.3, 12}, {6.2, 3}, {7.8, 0}}};

Quaternion about(const Vec3& axis, double degrees) {
    const double half = degrees * std::numbers::pi / 360;
    const double s = std::sin(half);
    return {s * axis.x, s * axis.y, s * axis.z, std::cos(half)};
}

Quaternion product(const Quaternion& a, const Quaternion& b) {
    const Vec3 u{a.x, a.y, a.z}, v{b.x, b.y, b.z};
    const Vec3 w = a.w * v + b.w * u + cross(u, v);
    return {w.x, w.y, w.z, a.w * b.w - dot(u, v)};
}

// The performer sits in a capture room, turned a little to the side; the head turns about the top of the neck.
Pose head_pose(double time) {
    const Quaternion seat = about({0, 1, 0}, 7);
    const Quaternion moved = product(product(about({0, 1, 0}, at(turn, time)), about({1, 0, 0}, at(nod, time))),
                                     about({0, 0, 1}, at(tilt, time)));
    const Quaternion rotation = product(seat, moved);
    const Vec3 pivot{0, -60, -20};
    const Vec3 seat_place{140 + at(sway, time), 1210 + at(lean, time) / 3, 60 + at(lean, time)};
    return {rotation, seat_place + pivot - rotate(rotation, pivot)};
}

// The performer's neutral marker places from the sample head's: broader, shorter, each marker glued on a little off.
Vec3 performer_place(const Vec3& p, std::size_t marker) {
    const auto k = static_cast<double>(marker);
    return {1.05 * p.x + .6 * std::sin(2.1 * k), .97 * p.y + .6 * std::sin(1.3 * k + 1),
            .98 * p.z + .5 * std::sin(1.7 * k + 2)};
}

const HeadPoint& point_of(const Head& head, const std::string& id) {
    return *std::find_if(head.points.begin(), head.points.end(), [&](const HeadPoint& p) { return p.id == id; });
}

// The left or midline point that a right one mirrors, from the names in the table: L and R markers are neighbours.
struct Side {
    std::string id;
    double sign = 1;
};

Side side_of(std::size_t marker) {
    if (markers[marker].name[0] != 'R') return {markers[marker].id, 1};
    const std::string left = std::string("L") + (markers[marker].name + 1);
    for (const Marker& m : markers)
        if (left == m.name) return {m.id, -1};
    return {"", -1};
}

// Both sides never do quite the same: the left leads by a hundredth of a second and goes a little further.
Vec3 displacement(std::size_t marker, double time) {
    const Side side = side_of(marker);
    Vec3 sum;
    for (const Action& action : actions())
        for (const Displacement& move : action.moves) {
            if (side.id != move.id) continue;
            const double amount = side.sign > 0 ? at(action.keys, time) : .94 * at(action.keys, time - .01);
            sum += amount * Vec3{side.sign * move.mm.x, move.mm.y, move.mm.z};
        }
    return sum;
}

std::size_t marker_number(const std::string& name) {
    const auto found =
        std::find_if(std::begin(markers), std::end(markers), [&](const Marker& m) { return name == m.name; });
    return static_cast<std::size_t>(found - std::begin(markers));
}

// Shuts the lids: the upper one comes down most of the gap over the bulge of the eye, the lower one up the rest.
void shut(std::span<Vec3> row, const char* upper_name, const char* lower_name, double amount) {
    Vec3 &upper = row[marker_number(upper_name)], &lower = row[marker_number(lower_name)];
    const Vec3 gap = lower - upper;
    const double bulge = amount * (2.2 - amount);
    upper += (.9 * amount) * gap + Vec3{0, 0, bulge};
    lower += (-.08 * amount) * gap + Vec3{0, 0, .8 * amount};
}

struct Gap {
    const char* marker;
    std::size_t first, rows;
};
// Lost where the marker is at rest, so that a face that is driven without filling gaps does not jump.
constexpr Gap gaps[]{{"LMouthCorner", 33, 3}, {"RMouthCorner", 62, 9}, {"LipLowMid", 100, 6},   {"RCheek", 131, 12},
                     {"LipUpMid", 141, 5},    {"ChinMid", 136, 18},    {"LBrowOuter", 172, 7},  {"LChin", 190, 11},
                     {"LLidUp", 240, 4},      {"HeadR", 300, 10},      {"RBrowInner", 371, 14}, {"LNostril", 384, 5},
                     {"HeadTop", 447, 8}};

}  // namespace

Performance perform(const Head& head) {
    Performance result;
    Take& take = result.take;
    take.unit = "mm";
    for (const Marker& m : markers) {
        take.points.emplace_back(m.name);
        result.names.push_back({m.name, m.id});
    }
    for (int i = 0; i < rate * seconds; ++i) {
        const double time = i / rate;
        take.times.push_back(time);
        std::vector<Vec3> row;
        for (std::size_t m = 0; m < std::size(markers); ++m)
            row.push_back(performer_place(place(head, point_of(head, markers[m].id)), m) + displacement(m, time));
        shut(row, "LLidUp", "LLidLow", at(blink, time));
        shut(row, "RLidUp", "RLidLow", at(blink, time));
        const Pose pose = head_pose(time);
        for (const Vec3& p : row) take.samples.push_back(apply(pose, p));
    }
    for (const Gap& gap : gaps)
        for (std::size_t r = gap.first; r < gap.first + gap.rows; ++r)
            mien::row(take, r)[marker_number(gap.marker)] = lost_sample;
    return result;
}

}  // namespace mien::samples
