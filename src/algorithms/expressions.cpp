// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Visemes and expressions as sums of ARKit shapes. The weights were set by eye on heads of different people, a monkey
// among them: a viseme must read as its sound with the mouth alone, so a bilabial seals the lips, a labiodental lifts
// the upper lip off the rolled lower one, and what is spoken with the teeth shows them.

#include "mien/algorithms/expressions.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace mien {

namespace {

constexpr ShapePart PP[] = {{"mouthRollLower", 0.5}, {"mouthRollUpper", 0.55}, {"mouthPress", 0.25}};
constexpr ShapePart FF[] = {{"mouthRollLower", 0.9}, {"mouthUpperUp", 0.45}, {"mouthShrugLower", 0.25}};
constexpr ShapePart TH[] = {{"jawOpen", 0.14}, {"mouthLowerDown", 0.2}, {"mouthUpperUp", 0.12}, {"tongueOut", 0.45}};
constexpr ShapePart DD[] = {{"jawOpen", 0.1}, {"mouthLowerDown", 0.35}, {"mouthUpperUp", 0.15}, {"mouthStretch", 0.15}};
constexpr ShapePart kk[] = {{"jawOpen", 0.18}, {"mouthLowerDown", 0.2}, {"mouthUpperUp", 0.2}};
constexpr ShapePart CH[] = {{"mouthFunnel", 0.55}, {"jawOpen", 0.03}, {"mouthUpperUp", 0.12}, {"mouthLowerDown", 0.2}};
constexpr ShapePart SS[] = {
    {"mouthSmile", 0.2}, {"mouthStretch", 0.25}, {"mouthLowerDown", 0.4}, {"mouthUpperUp", 0.15}, {"jawOpen", 0.02}};
constexpr ShapePart nn[] = {{"jawOpen", 0.1}, {"mouthLowerDown", 0.25}, {"mouthUpperUp", 0.1}};
constexpr ShapePart RR[] = {{"mouthFunnel", 0.4}, {"mouthPucker", 0.3}, {"jawOpen", 0.08}};
constexpr ShapePart aa[] = {{"jawOpen", 0.6}, {"mouthLowerDown", 0.1}, {"mouthUpperUp", 0.1}};
constexpr ShapePart E[] = {
    {"jawOpen", 0.25}, {"mouthSmile", 0.25}, {"mouthStretch", 0.2}, {"mouthLowerDown", 0.15}, {"mouthUpperUp", 0.1}};
constexpr ShapePart I[] = {
    {"jawOpen", 0.12}, {"mouthSmile", 0.4}, {"mouthStretch", 0.2}, {"mouthLowerDown", 0.2}, {"mouthUpperUp", 0.1}};
constexpr ShapePart O[] = {{"jawOpen", 0.4}, {"mouthFunnel", 0.5}, {"mouthPucker", 0.15}};
constexpr ShapePart U[] = {{"mouthPucker", 0.75}, {"mouthFunnel", 0.15}, {"jawOpen", 0.05}};

constexpr ShapePart happy[] = {{"mouthSmile", 0.9}, {"cheekSquint", 0.6}, {"eyeSquint", 0.4}};
constexpr ShapePart angry[] = {
    {"browDown", 1.3}, {"noseSneer", 0.55}, {"eyeSquint", 0.5}, {"mouthFrown", 0.5}, {"mouthShrugLower", 0.2}};
constexpr ShapePart sad[] = {
    {"browInnerUp", 0.8}, {"mouthFrown", 0.8}, {"mouthShrugLower", 0.4}, {"eyeLookDown", 0.2}, {"eyeBlink", 0.12}};
constexpr ShapePart relaxed[] = {{"mouthSmile", 0.4}, {"cheekSquint", 0.2}, {"eyeBlink", 0.3}, {"browInnerUp", 0.15}};
constexpr ShapePart surprised[] = {
    {"eyeWide", 1}, {"browInnerUp", 0.7}, {"browOuterUp", 0.9}, {"jawOpen", 0.35}, {"mouthFunnel", 0.1}};
constexpr ShapePart blink[] = {{"eyeBlink", 1}};
constexpr ShapePart blink_left[] = {{"eyeBlinkLeft", 1}};
constexpr ShapePart blink_right[] = {{"eyeBlinkRight", 1}};
constexpr ShapePart look_up[] = {{"eyeLookUp", 1}};
constexpr ShapePart look_down[] = {{"eyeLookDown", 1}};
constexpr ShapePart look_left[] = {{"eyeLookOutLeft", 1}, {"eyeLookInRight", 1}};
constexpr ShapePart look_right[] = {{"eyeLookInLeft", 1}, {"eyeLookOutRight", 1}};

constexpr NamedShape arkit(std::string_view name) {
    return {name, ShapeSet::arkit, {}};
}
constexpr NamedShape viseme(std::string_view name, std::span<const ShapePart> parts = {}) {
    return {name, ShapeSet::visemes, parts};
}
constexpr NamedShape vrm(std::string_view name, std::span<const ShapePart> parts = {}) {
    return {name, ShapeSet::vrm, parts};
}

constexpr std::size_t arkit_count = 52;
constexpr std::array table{
    arkit("eyeBlinkLeft"),
    arkit("eyeLookDownLeft"),
    arkit("eyeLookInLeft"),
    arkit("eyeLookOutLeft"),
    arkit("eyeLookUpLeft"),
    arkit("eyeSquintLeft"),
    arkit("eyeWideLeft"),
    arkit("eyeBlinkRight"),
    arkit("eyeLookDownRight"),
    arkit("eyeLookInRight"),
    arkit("eyeLookOutRight"),
    arkit("eyeLookUpRight"),
    arkit("eyeSquintRight"),
    arkit("eyeWideRight"),
    arkit("jawForward"),
    arkit("jawLeft"),
    arkit("jawRight"),
    arkit("jawOpen"),
    arkit("mouthClose"),
    arkit("mouthFunnel"),
    arkit("mouthPucker"),
    arkit("mouthLeft"),
    arkit("mouthRight"),
    arkit("mouthSmileLeft"),
    arkit("mouthSmileRight"),
    arkit("mouthFrownLeft"),
    arkit("mouthFrownRight"),
    arkit("mouthDimpleLeft"),
    arkit("mouthDimpleRight"),
    arkit("mouthStretchLeft"),
    arkit("mouthStretchRight"),
    arkit("mouthRollLower"),
    arkit("mouthRollUpper"),
    arkit("mouthShrugLower"),
    arkit("mouthShrugUpper"),
    arkit("mouthPressLeft"),
    arkit("mouthPressRight"),
    arkit("mouthLowerDownLeft"),
    arkit("mouthLowerDownRight"),
    arkit("mouthUpperUpLeft"),
    arkit("mouthUpperUpRight"),
    arkit("browDownLeft"),
    arkit("browDownRight"),
    arkit("browInnerUp"),
    arkit("browOuterUpLeft"),
    arkit("browOuterUpRight"),
    arkit("cheekPuff"),
    arkit("cheekSquintLeft"),
    arkit("cheekSquintRight"),
    arkit("noseSneerLeft"),
    arkit("noseSneerRight"),
    arkit("tongueOut"),
    viseme("viseme_sil"),
    viseme("viseme_PP", PP),
    viseme("viseme_FF", FF),
    viseme("viseme_TH", TH),
    viseme("viseme_DD", DD),
    viseme("viseme_kk", kk),
    viseme("viseme_CH", CH),
    viseme("viseme_SS", SS),
    viseme("viseme_nn", nn),
    viseme("viseme_RR", RR),
    viseme("viseme_aa", aa),
    viseme("viseme_E", E),
    viseme("viseme_I", I),
    viseme("viseme_O", O),
    viseme("viseme_U", U),
    vrm("neutral"),
    vrm("aa", aa),
    vrm("ih", I),
    vrm("ou", U),
    vrm("ee", E),
    vrm("oh", O),
    vrm("blink", blink),
    vrm("blinkLeft", blink_left),
    vrm("blinkRight", blink_right),
    vrm("happy", happy),
    vrm("angry", angry),
    vrm("sad", sad),
    vrm("relaxed", relaxed),
    vrm("surprised", surprised),
    vrm("lookUp", look_up),
    vrm("lookDown", look_down),
    vrm("lookLeft", look_left),
    vrm("lookRight", look_right),
};
static_assert(table[arkit_count - 1].set == ShapeSet::arkit && table[arkit_count].set == ShapeSet::visemes);

std::optional<std::string_view> named(std::string_view name) {
    const auto found = std::find_if(table.begin(), table.end(), [&](const NamedShape& s) { return s.name == name; });
    return found == table.end() ? std::nullopt : std::optional(found->name);
}

}  // namespace

std::span<const NamedShape> named_shapes() {
    return table;
}

std::optional<std::string_view> standard_shape(std::string_view name) {
    if (const auto found = named(name)) return found;
    std::string spelled(name);
    if (spelled.ends_with("_L")) spelled.replace(spelled.size() - 2, 2, "Left");
    if (spelled.ends_with("_R")) spelled.replace(spelled.size() - 2, 2, "Right");
    if (const auto found = named(spelled)) return found;
    if (spelled.empty()) return std::nullopt;
    spelled[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(spelled[0])));
    return named(spelled);
}

std::string_view mirror_shape(std::string_view name) {
    for (const auto& [side, other] : {std::pair{"Left", "Right"}, {"Right", "Left"}}) {
        if (!name.ends_with(side)) continue;
        const std::string_view stem = name.substr(0, name.size() - std::string_view(side).size());
        if (const auto found = named(std::string(stem) + other)) return *found;
    }
    return name;
}

ShapeSides sides_of(std::string_view part) {
    if (const auto whole = named(part)) return {*whole, {}};
    const auto left = named(std::string(part) + "Left"), right = named(std::string(part) + "Right");
    return left && right ? ShapeSides{*left, *right} : ShapeSides{};
}

}  // namespace mien
