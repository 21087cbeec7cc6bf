// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The figures are rounded from the expressions of ICT-FaceKit ("ICT Face Model Light"), under its licence:
//
//     MIT License
//
//     Copyright (c) 2020 USC Institute for Creative Technologies
//
//     Permission is hereby granted, free of charge, to any person obtaining a copy
//     of this software and associated documentation files (the "Software"), to deal
//     in the Software without restriction, including without limitation the rights
//     to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
//     copies of the Software, and to permit persons to whom the Software is
//     furnished to do so, subject to the following conditions:
//
//     The above copyright notice and this permission notice shall be included in all
//     copies or substantial portions of the Software.
//
//     THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
//     IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
//     FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
//     AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
//     LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
//     OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
//     SOFTWARE.

#include "algorithms/shape_motions.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "mien/face.hpp"

namespace mien {

namespace {

// In thousandths of an eye distance.
struct Motion {
    std::string_view point;
    short x, y, z;
};

// Of the subject's left side, with what they move elsewhere.
constexpr Motion brow_down[] = {{"3.1", -2, -3, 1}, {"3.7", -1, -3, 1},    {"3.13", -13, -13, 9}, {"4.1", -27, -28, 17},
                                {"4.2", 7, -7, 4},  {"4.3", -73, -58, 44}, {"4.5", -34, -13, 49}};
constexpr Motion eye_blink[] = {{"3.1", -16, -151, 4}, {"3.3", -50, 3, 3},  {"3.7", -6, -15, 3}, {"3.9", -39, 7, 1},
                                {"3.11", -9, -4, -4},  {"3.13", 0, -10, 2}, {"4.3", 0, -2, 1}};
constexpr Motion eye_look_down[] = {{"3.1", -3, -118, -8}, {"3.3", -1, -33, -19}, {"3.7", -8, -39, -4},
                                    {"3.9", -1, -15, -22}, {"3.11", 2, -10, -1},  {"3.13", -4, -86, 25},
                                    {"4.3", 0, -4, 1},     {"4.5", 0, -4, 1}};
constexpr Motion eye_squint[] = {{"2.13", 1, 3, 1},    {"3.1", 0, -2, 0},  {"3.3", -16, 36, 14}, {"3.7", -5, 4, 8},
                                 {"3.9", -34, 39, 16}, {"3.11", -3, 7, 0}, {"3.13", 0, -4, 0},   {"4.3", -1, -2, 1},
                                 {"4.5", -2, -3, 3},   {"5.1", -3, 10, 4}, {"5.3", -23, 25, 7}};
constexpr Motion jaw_aside[] = {{"2.1", 137, 2, 2},    {"2.2", 25, 0, 0},   {"2.3", 125, 4, 13},  {"2.4", 87, 6, -2},
                                {"2.5", 77, 2, 14},    {"2.6", 32, 1, 0},   {"2.7", 28, 0, 1},    {"2.8", 128, 4, 2},
                                {"2.9", 115, 5, 28},   {"2.10", 140, 4, 2}, {"2.11", 130, 3, -4}, {"2.12", 128, 1, 4},
                                {"2.13", 54, -1, -13}, {"2.14", 40, -4, 0}, {"5.1", 21, 5, -13},  {"5.2", 24, -3, 10},
                                {"5.3", 4, 0, 0},      {"5.4", 6, 0, 0},    {"8.1", 26, 0, 0},    {"8.2", 125, 5, 14},
                                {"8.3", 79, 6, 0},     {"8.4", 71, -1, 12}, {"8.5", 33, 0, 1},    {"8.6", 29, 0, 2},
                                {"8.7", 133, 6, 1},    {"8.8", 115, 6, 28}, {"8.9", 26, 0, 1},    {"8.10", 28, 0, 0},
                                {"9.1", 7, -1, -1},    {"9.2", 7, 0, 0},    {"9.3", 6, 0, 0},     {"9.4", 14, 0, 1},
                                {"9.5", 15, -1, -1},   {"9.12", 3, 0, 0},   {"9.13", 2, 0, 0},    {"9.15", 14, 0, 0}};
constexpr Motion mouth_smile[] = {
    {"2.1", 0, 25, 15},    {"2.2", 0, 30, -18},  {"2.3", 0, 30, -7},    {"2.4", 110, 156, -134}, {"2.6", 60, 61, -61},
    {"2.7", -19, 19, -19}, {"2.8", 51, 65, -47}, {"2.9", -15, 20, -14}, {"2.10", 0, 33, 7},      {"2.11", 16, 65, 8},
    {"2.13", 24, 36, 11},  {"3.3", 0, 10, 4},    {"3.7", 0, 3, 1},      {"3.9", 5, 20, 8},       {"5.1", 105, 96, -11},
    {"5.3", 35, 61, 22},   {"8.1", 0, 28, -26},  {"8.2", 0, 32, -17},   {"8.3", 112, 167, -144}, {"8.5", 65, 65, -77},
    {"8.6", -11, 11, -13}, {"8.7", 45, 69, -56}, {"8.8", -10, 16, -13}, {"8.9", -14, 18, -20},   {"8.10", 30, 40, -44},
    {"9.1", 26, 31, -8},   {"9.4", -6, 6, -4},   {"9.5", 33, 30, -22},  {"9.13", 3, 3, 1},       {"9.15", 0, 6, -11}};
constexpr Motion mouth_frown[] = {
    {"2.1", 0, 8, 11},     {"2.2", 0, -6, -7},   {"2.3", 0, -4, -1},  {"2.4", 29, -61, -21}, {"2.6", 7, -15, -10},
    {"2.7", -2, -5, -3},   {"2.8", 9, -12, 2},   {"2.9", -3, -4, 1},  {"2.10", 0, 8, 12},    {"2.11", -1, -4, 24},
    {"2.13", -5, -4, 6},   {"5.1", 1, -22, 4},   {"5.3", -4, -5, 3},  {"8.1", 0, -9, -5},    {"8.2", 0, -2, 0},
    {"8.3", 30, -72, -29}, {"8.5", 8, -22, -13}, {"8.6", -1, -4, -2}, {"8.7", 8, -7, 5},     {"8.9", -1, -6, -3},
    {"8.10", 3, -14, -8},  {"9.1", -2, -15, -3}, {"9.3", 0, -3, -1},  {"9.4", 0, -3, -1},    {"9.5", 2, -18, -5},
    {"9.12", 0, -2, 1},    {"9.13", -1, -4, 0},  {"9.15", 0, -5, -3}};
constexpr Motion mouth_upper_up[] = {
    {"2.2", 0, 61, -5},  {"2.3", 0, 4, -2},     {"2.4", -2, 53, -6},  {"2.6", 23, 94, -4}, {"2.7", -7, 29, -1},
    {"2.8", 1, 10, 0},   {"2.9", 0, 3, 0},      {"2.10", 0, 2, 1},    {"2.11", 1, 3, 4},   {"2.13", 0, 4, 9},
    {"3.3", 0, 5, 1},    {"3.9", 2, 13, 5},     {"5.1", 2, 46, 27},   {"5.3", 10, 33, 8},  {"8.1", 0, 63, -10},
    {"8.2", 0, 3, -1},   {"8.3", 3, 69, 4},     {"8.5", 28, 118, -9}, {"8.6", -5, 20, -2}, {"8.7", 1, 7, -1},
    {"8.9", -7, 41, -6}, {"8.10", 15, 91, -13}, {"9.1", 33, 76, -1},  {"9.4", -4, 13, -4}, {"9.5", 27, 80, -23},
    {"9.13", 0, 17, 8},  {"9.14", 0, 5, 2},     {"9.15", 0, 21, -10}};
constexpr Motion nose_sneer[] = {
    {"2.1", 0, 5, 2},     {"2.2", 0, 56, 1},   {"2.3", 0, 7, 2},     {"2.4", -18, 78, 0}, {"2.6", 9, 95, -2},
    {"2.7", -3, 29, -1},  {"2.8", -1, 18, 6},  {"2.9", 0, 5, 2},     {"2.10", 0, 5, 1},   {"2.11", 2, 18, 7},
    {"2.13", -3, 14, 24}, {"3.3", -1, 22, 4},  {"3.9", -2, 42, 12},  {"3.11", 0, 4, 0},   {"3.13", -2, -5, 2},
    {"4.1", -7, -46, 2},  {"4.2", 2, -11, 0},  {"4.3", -14, -36, 9}, {"4.5", -5, -8, 7},  {"5.1", -33, 93, 45},
    {"5.3", -8, 81, 19},  {"8.1", 0, 61, -5},  {"8.2", 0, 5, 1},     {"8.3", -15, 99, 8}, {"8.5", 10, 124, -2},
    {"8.6", -2, 21, 0},   {"8.7", 0, 15, 4},   {"8.8", 0, 3, 1},     {"8.9", -2, 40, -2}, {"8.10", 5, 90, -5},
    {"9.1", 3, 131, 21},  {"9.3", 0, 29, 2},   {"9.4", -1, 18, 0},   {"9.5", 6, 100, 1},  {"9.6", -1, 0, 3},
    {"9.7", 2, 0, 6},     {"9.12", 0, 20, -3}, {"9.13", -9, 60, 24}, {"9.14", 2, 16, 7},  {"9.15", 0, 30, 4}};

// Of both sides alike: the midline and the subject's left.
constexpr Motion brow_inner_up[] = {{"3.1", 0, 3, -1},   {"3.9", -1, 3, 0},    {"3.11", 0, 3, 1},  {"3.13", 0, 9, -2},
                                    {"4.1", 7, 88, -4},  {"4.3", 4, 44, -5},   {"4.5", -3, 18, 0}, {"5.3", -1, 3, 0},
                                    {"9.1", 0, 9, 1},    {"9.3", 0, 17, -3},   {"9.5", 0, 5, 1},   {"9.7", -4, 39, -3},
                                    {"9.12", 0, 19, -6}, {"9.13", -2, 21, -6}, {"9.15", 0, 4, 1}};
constexpr Motion cheek_puff[] = {
    {"2.1", 0, 39, 31},    {"2.2", 0, 4, 114},    {"2.3", 0, 11, 139},   {"2.4", -42, 24, 214},  {"2.6", -35, 15, 145},
    {"2.8", -36, 14, 172}, {"2.10", 0, 47, 27},   {"2.11", 3, 26, 29},   {"2.13", 0, 17, 59},    {"3.3", -1, 3, 1},
    {"3.9", -3, 11, 5},    {"5.1", 64, 55, 151},  {"5.3", -4, 40, 15},   {"8.1", 0, 12, 122},    {"8.2", 0, -5, 138},
    {"8.3", -44, 26, 217}, {"8.5", -41, 20, 145}, {"8.7", -34, -2, 160}, {"8.10", -24, 15, 128}, {"9.1", 4, 29, 37},
    {"9.3", 0, 43, 11},    {"9.5", -6, 32, 103},  {"9.12", 0, 17, -5},   {"9.13", -2, 7, -2},    {"9.15", 0, 31, 87}};
constexpr Motion jaw_open[] = {
    {"2.1", 0, -447, -461}, {"2.2", 0, -39, -5},     {"2.3", 0, -558, -307},  {"2.4", -34, -241, -200},
    {"2.6", -4, -59, -32},  {"2.8", -4, -488, -288}, {"2.10", 0, -478, -463}, {"2.11", 27, -371, -412},
    {"2.13", -4, -32, -70}, {"3.3", 0, -3, 0},       {"3.9", -1, -9, -1},     {"5.1", -51, -80, -87},
    {"5.3", -4, -31, -2},   {"8.1", 0, -37, -5},     {"8.2", 0, -556, -340},  {"8.3", -45, -208, -178},
    {"8.5", 1, -61, -33},   {"8.7", 12, -490, -327}, {"8.10", 5, -43, -12},   {"9.1", -8, -30, -3},
    {"9.3", 0, -8, -1},     {"9.5", 5, -43, -2},     {"9.7", 0, -2, 1},       {"9.12", 0, -5, 4},
    {"9.13", -1, -9, -1},   {"9.15", 0, -19, -8}};
constexpr Motion mouth_funnel[] = {
    {"2.1", 0, -59, -20},    {"2.2", 0, 86, 100},   {"2.3", 0, -132, 105}, {"2.4", -55, -4, 135}, {"2.6", -34, 44, 120},
    {"2.8", -17, -105, 145}, {"2.10", 0, -72, -28}, {"2.11", 10, -24, -1}, {"2.13", -6, -2, 18},  {"3.9", -1, 2, 0},
    {"5.1", -41, 19, 28},    {"5.3", -4, 5, 3},     {"8.1", 0, 96, 111},   {"8.2", 0, -141, 67},  {"8.3", -54, 0, 131},
    {"8.5", 0, 64, 131},     {"8.7", -9, -105, 89}, {"8.10", 2, 84, 116},  {"9.1", 0, 12, -11},   {"9.3", 0, -12, -17},
    {"9.5", -5, 12, 9},      {"9.12", 0, -4, -3},   {"9.13", -2, 2, -5},   {"9.15", 0, 8, -2}};
constexpr Motion mouth_pucker[] = {
    {"2.1", 0, 11, 17},     {"2.2", 0, -5, 110},    {"2.3", 0, 3, 143},   {"2.4", -83, 34, 173}, {"2.6", -40, -14, 135},
    {"2.8", -40, 13, 167},  {"2.10", 0, 18, 12},    {"2.11", -4, 24, 27}, {"2.13", -10, -3, 20}, {"5.1", -43, 19, 42},
    {"5.3", -6, 3, 4},      {"8.1", 0, 58, 127},    {"8.2", 0, -30, 100}, {"8.3", -74, 34, 156}, {"8.5", -25, 46, 138},
    {"8.7", -33, -11, 123}, {"8.10", -11, 57, 126}, {"9.1", -6, 0, -8},   {"9.3", 0, -19, -19},  {"9.5", -12, 4, 32},
    {"9.12", 0, -9, -4},    {"9.13", -4, -5, -7},   {"9.15", 0, -6, 11}};
constexpr Motion mouth_roll_lower[] = {
    {"2.1", 0, -4, 7},   {"2.3", 0, 59, -204}, {"2.4", 8, -16, -39}, {"2.8", -11, 30, -163}, {"2.10", 0, 32, 25},
    {"2.11", -7, -1, 9}, {"2.13", 1, 2, 0},    {"8.2", 0, 148, -73}, {"8.3", 5, -6, -8},     {"8.7", -21, 119, -56}};
constexpr Motion mouth_shrug_lower[] = {{"2.1", 0, 129, 71}, {"2.3", 0, 109, 88},  {"2.4", 13, 37, 38},
                                        {"2.8", 18, 98, 80}, {"2.10", 0, 176, 34}, {"2.11", -9, 87, 51},
                                        {"2.13", -4, -2, 2}, {"5.1", 1, 5, 5},     {"8.2", 0, 121, 82},
                                        {"8.3", 11, 27, 32}, {"8.7", 8, 108, 74}};

using Motions = std::span<const Motion>;
constexpr Motions one_sided[] = {brow_down,   eye_blink,   eye_look_down,  eye_squint, jaw_aside,
                                 mouth_smile, mouth_frown, mouth_upper_up, nose_sneer};
constexpr Motions two_sided[] = {brow_inner_up, cheek_puff,       jaw_open,         mouth_funnel,
                                 mouth_pucker,  mouth_roll_lower, mouth_shrug_lower};

Vec3 motion_of(Motions motions, std::string_view id) {
    const auto found = std::find_if(motions.begin(), motions.end(), [&](const Motion& m) { return m.point == id; });
    return found == motions.end() ? Vec3{} : 0.001 * Vec3{double(found->x), double(found->y), double(found->z)};
}

Vec3 mirrored(const Vec3& v) {
    return {-v.x, v.y, v.z};
}

template <class Move>
std::vector<Vec3> each(std::span<const std::string> ids, Move&& move) {
    std::vector<Vec3> result;
    std::transform(ids.begin(), ids.end(), std::back_inserter(result), move);
    return result;
}

}  // namespace

std::vector<std::vector<Vec3>> shape_motions(std::span<const std::string> ids) {
    std::vector<std::vector<Vec3>> shapes;
    for (const Motions& motions : one_sided) {
        shapes.push_back(each(ids, [&](const std::string& id) { return motion_of(motions, id); }));
        shapes.push_back(
            each(ids, [&](const std::string& id) { return mirrored(motion_of(motions, mirror_point(id))); }));
    }
    for (const Motions& motions : two_sided)
        shapes.push_back(each(ids, [&](const std::string& id) {
            const Vec3 here = motion_of(motions, id);
            return here == Vec3{} ? mirrored(motion_of(motions, mirror_point(id))) : here;
        }));
    return shapes;
}

}  // namespace mien
