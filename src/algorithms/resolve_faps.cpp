// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What a decoder of ISO/IEC 14496-2 does before it moves a face: visemes and expressions are put into parameters, and
// missing parameters are interpolated, by the table of the face, left from right, and inner lip from outer lip and
// back.

#include "mien/algorithms/resolve_faps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

namespace mien {

namespace {

struct Amount {
    int fap;
    int value;
};

// A pose of both sides and both contours of the lips from one of each.
FapFrame pose(std::initializer_list<Amount> amounts) {
    FapFrame frame;
    const auto set = [&](int fap, int value) {
        frame.mask.set(fap_index(fap));
        frame.value[fap_index(fap)] = value;
    };
    for (const auto& [fap, value] : amounts)
        for (const int side : {fap, fap_info(fap).mirror}) {
            set(side, value);
            if (const int partner = fap_info(side).partner; partner != 0) set(partner, value);
        }
    return frame;
}

// A mouth: the jaw down, upper lip up and lower lip down at their middles (the points beside them go 0.7 of it),
// corners outwards and upwards, both lips forward, the tip of the tongue up and out.
struct Mouth {
    int jaw = 0, upper = 0, lower = 0, wide = 0, corners = 0, forward = 0, tongue_up = 0, tongue_out = 0;
};

FapFrame pose(const Mouth& mouth) {
    const auto beside = [](int value) { return static_cast<int>(std::lround(0.7 * value)); };
    return pose({{3, mouth.jaw},
                 {4, -mouth.upper},
                 {8, -beside(mouth.upper)},
                 {5, -mouth.lower},
                 {10, -beside(mouth.lower)},
                 {6, mouth.wide},
                 {12, mouth.corners},
                 {16, mouth.forward},
                 {17, mouth.forward},
                 {44, mouth.tongue_up},
                 {45, mouth.tongue_out}});
}

}  // namespace

FapPoses standard_poses() {
    FapPoses poses;
    poses.visemes = {FapFrame{},
                     pose(Mouth{.upper = -60, .lower = -80, .wide = -30, .forward = 40}),
                     pose(Mouth{.jaw = 60, .upper = 40, .lower = -120, .wide = 30, .forward = -60}),
                     pose(Mouth{.jaw = 150, .upper = 70, .lower = 150, .tongue_up = 100, .tongue_out = 150}),
                     pose(Mouth{.jaw = 120, .upper = 60, .lower = 140, .tongue_up = 200}),
                     pose(Mouth{.jaw = 170, .upper = 70, .lower = 180}),
                     pose(Mouth{.jaw = 100, .upper = 130, .lower = 180, .wide = -110, .forward = 200}),
                     pose(Mouth{.jaw = 50, .upper = 80, .lower = 120, .wide = 80}),
                     pose(Mouth{.jaw = 130, .upper = 60, .lower = 150, .tongue_up = 220}),
                     pose(Mouth{.jaw = 120, .upper = 90, .lower = 150, .wide = -90, .forward = 130}),
                     pose(Mouth{.jaw = 600, .upper = 100, .lower = 560}),
                     pose(Mouth{.jaw = 250, .upper = 100, .lower = 280, .wide = 80}),
                     pose(Mouth{.jaw = 130, .upper = 100, .lower = 200, .wide = 120}),
                     pose(Mouth{.jaw = 400, .upper = 100, .lower = 400, .wide = -120, .forward = 130}),
                     pose(Mouth{.jaw = 150, .upper = 60, .lower = 160, .wide = -200, .forward = 240})};
    poses.expressions = {
        FapFrame{},
        pose({{3, 100}, {4, -80}, {8, -60}, {5, -120}, {10, -80}, {6, 130}, {12, 180}, {41, 120}, {19, 60}, {21, 120}}),
        pose({{31, 180}, {33, 60}, {35, -60}, {37, 60}, {19, 180}, {12, -140}, {18, 80}}),
        pose({{31, -200}, {33, -120}, {35, -30}, {37, 160}, {19, -150}, {21, 60}, {4, 40}, {5, 60}, {61, 60}}),
        pose({{31, 220}, {33, 160}, {35, 80}, {37, 80}, {19, -220}, {21, 60}, {3, 150}, {4, -50}, {5, -160}, {6, 80}}),
        pose({{31, -80}, {33, -60}, {37, 60}, {19, 100}, {21, 80}, {4, -160}, {8, -130}, {61, 80}, {63, 60}, {41, 80}}),
        pose({{31, 250}, {33, 250}, {35, 250}, {19, -250}, {3, 450}, {4, -60}, {8, -40}, {5, -400}, {10, -300}})};
    return poses;
}

namespace {

// A sum of poses on its way.
struct Blend {
    FapMask mask;
    std::array<double, fap_count> value{};

    void add(const FapFrame& pose, double weight) {
        if (weight == 0) return;
        mask |= pose.mask;
        for (std::size_t i = 0; i < fap_count; ++i) value[i] += weight * pose.value[i];
    }
};

// The parameters of the frame that define a pose: of the mouth and the tongue for a viseme, any for an expression.
FapFrame defined(const FapFrame& frame, bool mouth_only) {
    FapFrame pose;
    for (std::size_t i = 2; i < fap_count; ++i) {
        const int group = faps[i].group;
        if (!frame.mask[i] || (mouth_only && group != 2 && group != 6 && group != 8)) continue;
        pose.mask.set(i);
        pose.value[i] = frame.value[i];
    }
    return pose;
}

// One way to one parameter, of those that a table has.
struct Rule {
    const FitLink* link;
    const FitTarget* target;
    FapMask sources;
};

// In an order in which each parameter comes after all that it may follow from, and its first link before its second:
// one pass over a frame is enough.
std::vector<Rule> rules_of(const FapInterpolation& fit) {
    std::vector<Rule> rules;
    for (const int fap : interpolated_faps(fit))
        for (const FitLink& link : fit.links)
            for (const FitTarget& target : link.to) {
                if (target.fap != fap) continue;
                rules.push_back({&link, &target, {}});
                for (const int source : link.from) rules.back().sources.set(fap_index(source));
            }
    return rules;
}

// What a decoder keeps from frame to frame.
class Resolver {
public:
    Resolver(FapPoses& poses, const FapInterpolation& fit, const FapMask& carried)
        : poses_(poses), rules_(rules_of(fit)), carried_(carried) {}

    FapFrame resolve(const FapFrame& frame) {
        if (frame.mask[0]) select_viseme(frame);
        if (frame.mask[1]) select_expression(frame);
        const Blend blend = blended();
        FapFrame result;
        result.number = frame.number;
        for (std::size_t i = 2; i < fap_count; ++i) {
            const bool asked = blend.mask[i] && !frame.mask[i];
            if (frame.mask[i]) sent_.mask.set(i), sent_.value[i] = frame.value[i];
            const bool interpolated = frame.interpolated[static_cast<std::size_t>(faps[i].group - 1)];
            const bool held = sent_.mask[i] && (frame.mask[i] || !interpolated);
            result.mask[i] = asked || held;
            if (result.mask[i])
                result.value[i] = asked ? static_cast<std::int32_t>(std::lround(blend.value[i])) : sent_.value[i];
        }
        interpolate(result);
        fill(result, [](std::size_t i) { return faps[i].mirror; });
        fill(result, [&](std::size_t i) { return carried_[i] ? 0 : faps[i].partner; });
        return result;
    }

private:
    void select_viseme(const FapFrame& frame) {
        viseme_ = frame.viseme;
        if (viseme_.define) poses_.visemes[viseme_.select1] = defined(frame, true);
    }

    void select_expression(const FapFrame& frame) {
        expression_ = frame.expression;
        if (expression_.define) poses_.expressions[expression_.select1] = defined(frame, false);
    }

    [[nodiscard]] Blend blended() const {
        Blend blend;
        blend.add(poses_.visemes[viseme_.select1], viseme_.blend / 63.0);
        blend.add(poses_.visemes[viseme_.select2], 1 - viseme_.blend / 63.0);
        blend.add(poses_.expressions[expression_.select1], expression_.intensity1 / 63.0);
        blend.add(poses_.expressions[expression_.select2], expression_.intensity2 / 63.0);
        return blend;
    }

    void interpolate(FapFrame& frame) const {
        for (const Rule& rule : rules_) {
            const std::size_t i = fap_index(rule.target->fap);
            if (frame.mask[i] || (frame.mask & rule.sources) != rule.sources) continue;
            const std::optional<std::int32_t> value = interpolated_value(*rule.link, *rule.target, frame.value);
            if (!value) continue;
            frame.mask.set(i);
            frame.value[i] = *value;
        }
    }

    // From the parameter that `source` names, where that one is known and this one is not.
    template <class Source>
    static void fill(FapFrame& frame, const Source& source) {
        const FapFrame known = frame;
        for (std::size_t i = 2; i < fap_count; ++i) {
            const int from = source(i);
            if (known.mask[i] || from == 0 || !known.mask[fap_index(from)]) continue;
            frame.mask.set(i);
            frame.value[i] = known.value[fap_index(from)];
        }
    }

    FapPoses& poses_;
    std::vector<Rule> rules_;
    FapMask carried_;
    Viseme viseme_;
    Expression expression_;
    FapFrame sent_;  // the last value of each parameter that was ever sent
};

}  // namespace

FapMask carried_contours(std::span<const FeaturePoint> points) {
    FapMask carried;
    for (std::size_t i = 0; i < fap_count; ++i)
        if (faps[i].partner != 0 && find_point(points, faps[i].point) &&
            find_point(points, fap_info(faps[i].partner).point))
            carried.set(i);
    return carried;
}

FapStream resolve_faps(const FapStream& stream, FapPoses poses, const FapInterpolation& fit, const FapMask& carried) {
    FapStream resolved{stream.version, stream.name, stream.rate, {}};
    resolved.frames.reserve(stream.frames.size());
    Resolver resolver(poses, fit, carried);
    for (const FapFrame& frame : stream.frames) resolved.frames.push_back(resolver.resolve(frame));
    return resolved;
}

namespace {

// Which visemes and expressions a table has.
struct HighLevels {
    std::array<bool, viseme_names.size()> visemes{};
    std::array<bool, expression_names.size()> expressions{};
};

HighLevels high_levels(const Fat& fat) {
    HighLevels has;
    for (const FaceDefTables& table : fat.tables) {
        if (table.fap == 1) has.visemes.at(static_cast<std::size_t>(table.high_level_select)) = true;
        if (table.fap == 2) has.expressions.at(static_cast<std::size_t>(table.high_level_select)) = true;
    }
    return has;
}

template <std::size_t count>
bool has(const std::array<bool, count>& selects, std::size_t select) {
    return select < count && selects[select];
}

}  // namespace

FapStream resolve_faps(const FapStream& stream, const Fat& fat, const FapInterpolation& fit) {
    const HighLevels own = high_levels(fat);
    FapPoses poses = standard_poses();
    for (std::size_t s = 0; s < own.visemes.size(); ++s)
        if (own.visemes[s]) poses.visemes[s] = {};
    for (std::size_t s = 0; s < own.expressions.size(); ++s)
        if (own.expressions[s]) poses.expressions[s] = {};
    FapStream asked = stream;
    for (FapFrame& frame : asked.frames) {
        if (has(own.visemes, frame.viseme.select1)) frame.viseme.define = false;
        if (has(own.expressions, frame.expression.select1)) frame.expression.define = false;
    }
    FapStream resolved = resolve_faps(asked, poses, fit);
    Viseme viseme;
    Expression expression;
    for (std::size_t i = 0; i < resolved.frames.size(); ++i) {
        const FapFrame& sent = asked.frames[i];
        if (sent.mask[fap_index(1)]) viseme = sent.viseme;
        if (sent.mask[fap_index(2)]) expression = sent.expression;
        FapFrame& frame = resolved.frames[i];
        frame.mask[fap_index(1)] = has(own.visemes, viseme.select1) || has(own.visemes, viseme.select2);
        frame.mask[fap_index(2)] = has(own.expressions, expression.select1) || has(own.expressions, expression.select2);
        if (frame.mask[fap_index(1)]) frame.viseme = viseme;
        if (frame.mask[fap_index(2)]) frame.expression = expression;
    }
    return resolved;
}

}  // namespace mien
