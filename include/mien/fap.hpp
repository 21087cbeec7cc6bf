// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mien/face.hpp"

namespace mien {

/// Face animation parameters of MPEG-4 (ISO/IEC 14496-2, Annex C) are numbered from 1 to 68; arrays hold them from 0.
inline constexpr std::size_t fap_count = 68;

constexpr std::size_t fap_index(int fap) {
    return static_cast<std::size_t>(fap - 1);
}

/// What one unit of a parameter is measured in: a 1024th of a distance on the neutral face, or 1e-5 radians.
enum class FapUnit { none, irisd, es, ens, mns, mw, angle };

/// What a parameter does to its feature point: moves it along an axis, turns it about an axis in the right-handed
/// sense, widens the pupil, or rolls the tongue.
enum class FapAxis { none, x, y, z, turn_x, turn_y, turn_z, scale, roll };

struct FapRange {
    int low = 0, high = 0;
};

/// One row of the standard's table.
struct Fap {
    std::string_view name;
    FapUnit unit = FapUnit::none;
    FapAxis axis = FapAxis::none;
    int sign = 0;                 ///< +1 when positive values go along the axis, -1 when against it
    bool unidirectional = false;  ///< meant to stay positive; real files do not always keep to it
    int group = 0;                ///< 1 to 10
    std::string_view point;       ///< the feature point it acts on; empty for visemes and expressions
    int quant_step = 1;           ///< FAP units in one quantised level at fap_quant 1
    FapRange intra, inter;        ///< limits of values and of differences, in levels at fap_quant 1
    int mirror = 0;               ///< the parameter of the other side of the face; itself on the midline
    int mirror_sign = 1;          ///< what a mirrored performance multiplies it by
    int partner = 0;              ///< inner lip to outer lip and back; 0 for all others
};

/// FAP 1: a blend of two visemes, select1 * blend / 63 + select2 * (1 - blend / 63). With `define` the other parameters
/// of the frame say what select1 looks like from now on.
struct Viseme {
    std::uint8_t select1 = 0, select2 = 0;  ///< 0 to 14
    std::uint8_t blend = 0;                 ///< 0 to 63
    bool define = false;
    friend constexpr bool operator==(const Viseme&, const Viseme&) = default;
};

/// FAP 2: a sum of two expressions, select1 * intensity1 / 63 + select2 * intensity2 / 63.
struct Expression {
    std::uint8_t select1 = 0;     ///< 0 to 6
    std::uint8_t intensity1 = 0;  ///< 0 to 63
    std::uint8_t select2 = 0;
    std::uint8_t intensity2 = 0;
    bool init_face = false;  ///< the neutral face may be another one while this lasts
    bool define = false;
    friend constexpr bool operator==(const Expression&, const Expression&) = default;
};

/// The parameters that a frame sends, by index.
using FapMask = std::bitset<fap_count>;

/// One frame: what is not in the mask is not sent, and is zero here.
struct FapFrame {
    std::uint32_t number = 0;  ///< frames since the beginning: the time is number / rate
    FapMask mask;
    std::bitset<10> interpolated;                 ///< by group: what is not sent is to be interpolated, not held
    std::array<std::int32_t, fap_count> value{};  ///< FAP units; 0 for FAPs 1 and 2, which are not amplitudes
    Viseme viseme;
    Expression expression;
    friend bool operator==(const FapFrame&, const FapFrame&) = default;
};

/// A performance as face animation parameters: it plays on any face, in that face's own units.
struct FapStream {
    std::string version = "2.1";   ///< as a text file states it
    std::string name = "mien";     ///< likewise
    double rate = 25;              ///< frames per second, above 0
    std::vector<FapFrame> frames;  ///< their numbers rise; a number that is left out is a frame that was skipped
};

/// How large a face is in the sense of the standard, and what its points are when it rests: what parameters are taken
/// relative to. Distances are those of the neutral face, in its unit; a FAP unit is a 1024th of them.
struct Fapu {
    double irisd = 0;  ///< iris diameter, taken as the distance between the lids: 3.1.y - 3.3.y
    double es = 0;     ///< eye separation: 3.5.x - 3.6.x
    double ens = 0;    ///< from the eyes to the nose: 3.5.y - 9.15.y
    double mns = 0;    ///< from the nose to the mouth: 9.15.y - 2.2.y
    double mw = 0;     ///< mouth width: 8.3.x - 8.4.x

    std::vector<FeaturePoint> points;  ///< the neutral face
    Vec3 left_eye, right_eye;          ///< centres of the eyeballs
    Vec3 neck;                         ///< 7.1, about which the head turns

    /// What was missing and what took its place, a sentence each.
    std::vector<std::string> estimated;
    /// The units that were taken from other points than those that define them; eye separation between the middles of
    /// the corners is as good as between pupils and not among them.
    std::vector<FapUnit> uncertain;
};

/// The length (or the angle in radians) that one unit stands for on this face; 0 for none.
constexpr double unit_length(const Fapu& fapu, FapUnit unit) {
    switch (unit) {
        case FapUnit::irisd:
            return fapu.irisd / 1024;
        case FapUnit::es:
            return fapu.es / 1024;
        case FapUnit::ens:
            return fapu.ens / 1024;
        case FapUnit::mns:
            return fapu.mns / 1024;
        case FapUnit::mw:
            return fapu.mw / 1024;
        case FapUnit::angle:
            return 1e-5;
        case FapUnit::none:
            break;
    }
    return 0;
}

/// A viseme of FAP 1: the short name in common use, and the phonemes it shows, in SAMPA.
struct VisemeName {
    std::string_view name, phonemes;
};

/// The 14 visemes, and 0: none.
inline constexpr std::array<VisemeName, 15> viseme_names{{
    {"sil", ""},
    {"PP", "p, b, m"},
    {"FF", "f, v"},
    {"TH", "T, D"},
    {"DD", "t, d"},
    {"kk", "k, g"},
    {"CH", "tS, dZ, S"},
    {"SS", "s, z"},
    {"nn", "n, l"},
    {"RR", "r"},
    {"aa", "A:"},
    {"E", "e"},
    {"ih", "I"},
    {"oh", "Q"},
    {"ou", "U"},
}};

/// The 6 expressions of FAP 2, and 0: none.
inline constexpr std::array<std::string_view, 7> expression_names{"none", "joy",     "sadness", "anger",
                                                                  "fear", "disgust", "surprise"};

/// The first parameter of every group, by index, and the end of the last: groups are runs of the table.
inline constexpr std::array<std::size_t, 11> fap_group_starts{0, 2, 18, 30, 38, 42, 47, 50, 60, 64, 68};

/// The table of the standard, by index. The range of FAP 47 is not settled between sources; here it is 0 to 300.
inline constexpr std::array<Fap, fap_count> faps{{
    {"viseme", FapUnit::none, FapAxis::none, 0, false, 1, "", 1, {0, 0}, {0, 0}, 1, 1, 0},
    {"expression", FapUnit::none, FapAxis::none, 0, false, 1, "", 1, {0, 0}, {0, 0}, 2, 1, 0},
    {"open_jaw", FapUnit::mns, FapAxis::y, -1, true, 2, "2.1", 4, {0, 1080}, {-360, 360}, 3, 1, 0},
    {"lower_t_midlip", FapUnit::mns, FapAxis::y, -1, false, 2, "2.2", 2, {-600, 600}, {-180, 180}, 4, 1, 51},
    {"raise_b_midlip", FapUnit::mns, FapAxis::y, 1, false, 2, "2.3", 2, {-1860, 1860}, {-600, 600}, 5, 1, 52},
    {"stretch_l_cornerlip", FapUnit::mw, FapAxis::x, 1, false, 2, "2.4", 2, {-600, 600}, {-180, 180}, 7, 1, 53},
    {"stretch_r_cornerlip", FapUnit::mw, FapAxis::x, -1, false, 2, "2.5", 2, {-600, 600}, {-180, 180}, 6, 1, 54},
    {"lower_t_lip_lm", FapUnit::mns, FapAxis::y, -1, false, 2, "2.6", 2, {-600, 600}, {-180, 180}, 9, 1, 55},
    {"lower_t_lip_rm", FapUnit::mns, FapAxis::y, -1, false, 2, "2.7", 2, {-600, 600}, {-180, 180}, 8, 1, 56},
    {"raise_b_lip_lm", FapUnit::mns, FapAxis::y, 1, false, 2, "2.8", 2, {-1860, 1860}, {-600, 600}, 11, 1, 57},
    {"raise_b_lip_rm", FapUnit::mns, FapAxis::y, 1, false, 2, "2.9", 2, {-1860, 1860}, {-600, 600}, 10, 1, 58},
    {"raise_l_cornerlip", FapUnit::mns, FapAxis::y, 1, false, 2, "2.4", 2, {-600, 600}, {-180, 180}, 13, 1, 59},
    {"raise_r_cornerlip", FapUnit::mns, FapAxis::y, 1, false, 2, "2.5", 2, {-600, 600}, {-180, 180}, 12, 1, 60},
    {"thrust_jaw", FapUnit::mns, FapAxis::z, 1, true, 2, "2.1", 1, {0, 600}, {-180, 180}, 14, 1, 0},
    {"shift_jaw", FapUnit::mw, FapAxis::x, -1, false, 2, "2.1", 1, {-1080, 1080}, {-360, 360}, 15, -1, 0},
    {"push_b_lip", FapUnit::mns, FapAxis::z, 1, false, 2, "2.3", 1, {-1080, 1080}, {-360, 360}, 16, 1, 0},
    {"push_t_lip", FapUnit::mns, FapAxis::z, 1, false, 2, "2.2", 1, {-1080, 1080}, {-360, 360}, 17, 1, 0},
    {"depress_chin", FapUnit::mns, FapAxis::y, 1, false, 2, "2.10", 1, {-420, 420}, {-180, 180}, 18, 1, 0},
    {"close_t_l_eyelid", FapUnit::irisd, FapAxis::y, -1, false, 3, "3.1", 1, {-1080, 1080}, {-600, 600}, 20, 1, 0},
    {"close_t_r_eyelid", FapUnit::irisd, FapAxis::y, -1, false, 3, "3.2", 1, {-1080, 1080}, {-600, 600}, 19, 1, 0},
    {"close_b_l_eyelid", FapUnit::irisd, FapAxis::y, 1, false, 3, "3.3", 1, {-600, 600}, {-240, 240}, 22, 1, 0},
    {"close_b_r_eyelid", FapUnit::irisd, FapAxis::y, 1, false, 3, "3.4", 1, {-600, 600}, {-240, 240}, 21, 1, 0},
    {"yaw_l_eyeball", FapUnit::angle, FapAxis::turn_y, 1, false, 3, "3.5", 128, {-1200, 1200}, {-420, 420}, 24, -1, 0},
    {"yaw_r_eyeball", FapUnit::angle, FapAxis::turn_y, 1, false, 3, "3.6", 128, {-1200, 1200}, {-420, 420}, 23, -1, 0},
    {"pitch_l_eyeball", FapUnit::angle, FapAxis::turn_x, 1, false, 3, "3.5", 128, {-900, 900}, {-300, 300}, 26, 1, 0},
    {"pitch_r_eyeball", FapUnit::angle, FapAxis::turn_x, 1, false, 3, "3.6", 128, {-900, 900}, {-300, 300}, 25, 1, 0},
    {"thrust_l_eyeball", FapUnit::es, FapAxis::z, 1, false, 3, "3.5", 1, {-600, 600}, {-180, 180}, 28, 1, 0},
    {"thrust_r_eyeball", FapUnit::es, FapAxis::z, 1, false, 3, "3.6", 1, {-600, 600}, {-180, 180}, 27, 1, 0},
    {"dilate_l_pupil", FapUnit::irisd, FapAxis::scale, 1, false, 3, "3.5", 1, {-420, 420}, {-120, 120}, 30, 1, 0},
    {"dilate_r_pupil", FapUnit::irisd, FapAxis::scale, 1, false, 3, "3.6", 1, {-420, 420}, {-120, 120}, 29, 1, 0},
    {"raise_l_i_eyebrow", FapUnit::ens, FapAxis::y, 1, false, 4, "4.1", 2, {-900, 900}, {-360, 360}, 32, 1, 0},
    {"raise_r_i_eyebrow", FapUnit::ens, FapAxis::y, 1, false, 4, "4.2", 2, {-900, 900}, {-360, 360}, 31, 1, 0},
    {"raise_l_m_eyebrow", FapUnit::ens, FapAxis::y, 1, false, 4, "4.3", 2, {-900, 900}, {-360, 360}, 34, 1, 0},
    {"raise_r_m_eyebrow", FapUnit::ens, FapAxis::y, 1, false, 4, "4.4", 2, {-900, 900}, {-360, 360}, 33, 1, 0},
    {"raise_l_o_eyebrow", FapUnit::ens, FapAxis::y, 1, false, 4, "4.5", 2, {-900, 900}, {-360, 360}, 36, 1, 0},
    {"raise_r_o_eyebrow", FapUnit::ens, FapAxis::y, 1, false, 4, "4.6", 2, {-900, 900}, {-360, 360}, 35, 1, 0},
    {"squeeze_l_eyebrow", FapUnit::es, FapAxis::x, -1, false, 4, "4.1", 1, {-900, 900}, {-300, 300}, 38, 1, 0},
    {"squeeze_r_eyebrow", FapUnit::es, FapAxis::x, 1, false, 4, "4.2", 1, {-900, 900}, {-300, 300}, 37, 1, 0},
    {"puff_l_cheek", FapUnit::es, FapAxis::x, 1, false, 5, "5.1", 2, {-900, 900}, {-300, 300}, 40, 1, 0},
    {"puff_r_cheek", FapUnit::es, FapAxis::x, -1, false, 5, "5.2", 2, {-900, 900}, {-300, 300}, 39, 1, 0},
    {"lift_l_cheek", FapUnit::ens, FapAxis::y, 1, true, 5, "5.3", 2, {0, 600}, {-180, 180}, 42, 1, 0},
    {"lift_r_cheek", FapUnit::ens, FapAxis::y, 1, true, 5, "5.4", 2, {0, 600}, {-180, 180}, 41, 1, 0},
    {"shift_tongue_tip", FapUnit::mw, FapAxis::x, -1, false, 6, "6.1", 1, {-1080, 1080}, {-420, 420}, 43, -1, 0},
    {"raise_tongue_tip", FapUnit::mns, FapAxis::y, 1, false, 6, "6.1", 1, {-1080, 1080}, {-420, 420}, 44, 1, 0},
    {"thrust_tongue_tip", FapUnit::mw, FapAxis::z, 1, false, 6, "6.1", 1, {-1080, 1080}, {-420, 420}, 45, 1, 0},
    {"raise_tongue", FapUnit::mns, FapAxis::y, 1, false, 6, "6.2", 1, {-1080, 1080}, {-420, 420}, 46, 1, 0},
    {"tongue_roll", FapUnit::angle, FapAxis::roll, 1, true, 6, "6.3", 512, {0, 300}, {-60, 60}, 47, 1, 0},
    {"head_pitch", FapUnit::angle, FapAxis::turn_x, 1, false, 7, "7.1", 170, {-1860, 1860}, {-600, 600}, 48, 1, 0},
    {"head_yaw", FapUnit::angle, FapAxis::turn_y, 1, false, 7, "7.1", 170, {-1860, 1860}, {-600, 600}, 49, -1, 0},
    {"head_roll", FapUnit::angle, FapAxis::turn_z, 1, false, 7, "7.1", 170, {-1860, 1860}, {-600, 600}, 50, -1, 0},
    {"lower_t_midlip_o", FapUnit::mns, FapAxis::y, -1, false, 8, "8.1", 2, {-600, 600}, {-180, 180}, 51, 1, 4},
    {"raise_b_midlip_o", FapUnit::mns, FapAxis::y, 1, false, 8, "8.2", 2, {-1860, 1860}, {-600, 600}, 52, 1, 5},
    {"stretch_l_cornerlip_o", FapUnit::mw, FapAxis::x, 1, false, 8, "8.3", 2, {-600, 600}, {-180, 180}, 54, 1, 6},
    {"stretch_r_cornerlip_o", FapUnit::mw, FapAxis::x, -1, false, 8, "8.4", 2, {-600, 600}, {-180, 180}, 53, 1, 7},
    {"lower_t_lip_lm_o", FapUnit::mns, FapAxis::y, -1, false, 8, "8.5", 2, {-600, 600}, {-180, 180}, 56, 1, 8},
    {"lower_t_lip_rm_o", FapUnit::mns, FapAxis::y, -1, false, 8, "8.6", 2, {-600, 600}, {-180, 180}, 55, 1, 9},
    {"raise_b_lip_lm_o", FapUnit::mns, FapAxis::y, 1, false, 8, "8.7", 2, {-1860, 1860}, {-600, 600}, 58, 1, 10},
    {"raise_b_lip_rm_o", FapUnit::mns, FapAxis::y, 1, false, 8, "8.8", 2, {-1860, 1860}, {-600, 600}, 57, 1, 11},
    {"raise_l_cornerlip_o", FapUnit::mns, FapAxis::y, 1, false, 8, "8.3", 2, {-600, 600}, {-180, 180}, 60, 1, 12},
    {"raise_r_cornerlip_o", FapUnit::mns, FapAxis::y, 1, false, 8, "8.4", 2, {-600, 600}, {-180, 180}, 59, 1, 13},
    {"stretch_l_nose", FapUnit::ens, FapAxis::x, 1, false, 9, "9.1", 1, {-540, 540}, {-120, 120}, 62, 1, 0},
    {"stretch_r_nose", FapUnit::ens, FapAxis::x, -1, false, 9, "9.2", 1, {-540, 540}, {-120, 120}, 61, 1, 0},
    {"raise_nose", FapUnit::ens, FapAxis::y, 1, false, 9, "9.3", 1, {-680, 680}, {-180, 180}, 63, 1, 0},
    {"bend_nose", FapUnit::ens, FapAxis::x, -1, false, 9, "9.3", 1, {-900, 900}, {-180, 180}, 64, -1, 0},
    {"raise_l_ear", FapUnit::ens, FapAxis::y, 1, false, 10, "10.1", 1, {-900, 900}, {-240, 240}, 66, 1, 0},
    {"raise_r_ear", FapUnit::ens, FapAxis::y, 1, false, 10, "10.2", 1, {-900, 900}, {-240, 240}, 65, 1, 0},
    {"pull_l_ear", FapUnit::ens, FapAxis::x, 1, false, 10, "10.3", 1, {-900, 900}, {-300, 300}, 68, 1, 0},
    {"pull_r_ear", FapUnit::ens, FapAxis::x, -1, false, 10, "10.4", 1, {-900, 900}, {-300, 300}, 67, 1, 0},
}};

constexpr const Fap& fap_info(int fap) {
    return faps[fap_index(fap)];
}

}  // namespace mien
