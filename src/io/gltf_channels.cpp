// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Animations of glTF 2.0 (specification, 3.11).

#include "io/gltf_channels.hpp"

#include <fmt/format.h>
#include <optional>

#include "io/gltf_accessors.hpp"
#include "io/gltf_json.hpp"
#include "io/text.hpp"

namespace mien {

namespace {

using nlohmann::json;
using Between = Channel::Between;
using Property = Channel::Property;

std::optional<Property> property_of(const std::string& path) {
    if (path == "translation") return Property::translation;
    if (path == "rotation") return Property::rotation;
    if (path == "scale") return Property::scale;
    if (path == "weights") return Property::morph_weights;
    return std::nullopt;
}

Between between_of(const json& sampler, const std::string& pointer) {
    const std::string name = text_member(sampler, "interpolation", pointer);
    if (name.empty() || name == "LINEAR") return Between::linear;
    if (name == "STEP") return Between::step;
    if (name == "CUBICSPLINE") return Between::cubic;
    fail_at(pointer + "/interpolation", "LINEAR, STEP or CUBICSPLINE", shown(name));
}

// Numbers of one value of a channel.
std::size_t width_of(Property property, const Node& node) {
    switch (property) {
        case Property::rotation:
            return 4;
        case Property::morph_weights:
            return node.morph_weights.size();
        default:
            return 3;
    }
}

void check_times(const std::vector<float>& times, const std::string& pointer) {
    for (std::size_t k = 1; k < times.size(); ++k)
        if (times[k] < times[k - 1])
            fail_at(pointer, "ascending times", fmt::format("{} after {}", times[k], times[k - 1]));
}

// Reads what a sampler holds into a channel of values of `width` numbers.
void read_sampler(const GltfDocument& document, const json& sampler, const std::string& pointer, std::size_t width,
                  ReadBudget& budget, Channel& channel) {
    const std::size_t input = whole_member(sampler, "input", pointer);
    const std::size_t output = whole_member(sampler, "output", pointer);
    const std::size_t components = channel.property == Property::morph_weights ? 1 : width;
    channel.between = between_of(sampler, pointer);
    const std::uint64_t keys = accessor_count(document, input), found = accessor_count(document, output) * components;
    spend(budget.key_numbers, keys, "numbers of animations", pointer);
    spend(budget.key_numbers, found, "numbers of animations", pointer);
    const std::uint64_t expected = keys * width * (channel.between == Between::cubic ? 3 : 1);
    if (found != expected)
        fail_at(pointer + "/output", fmt::format("{} numbers for {} times", expected, keys), std::to_string(found));
    channel.times = read_floats(document, input, 1, pointer + "/input");
    check_times(channel.times, pointer + "/input");
    channel.values = read_floats(document, output, static_cast<unsigned>(components), pointer + "/output");
}

// Why a channel cannot be played; empty when it can.
std::string obstacle(const std::string& path, const Node& node) {
    const std::optional<Property> property = property_of(path);
    if (!property) return fmt::format("it moves {}", shown(path));
    if (*property == Property::morph_weights)
        return node.morph_weights.empty() ? "it moves morph targets that its node does not have" : "";
    return node.matrix ? "it moves a part of a node that has a matrix" : "";
}

}  // namespace

std::vector<Channel> read_channels(const GltfDocument& document, std::size_t number, DocumentScene& read) {
    const std::string at = fmt::format("/animations/{}", number);
    const json& animation = array_member(document.json, "animations", "")[number];
    const json& all = array_member(animation, "channels", at);
    const json& samplers = array_member(animation, "samplers", at);
    const std::vector<Node>& nodes = read.scene.nodes;
    std::vector<Channel> channels;
    for (std::size_t c = 0; c < all.size(); ++c) {
        const std::string pointer = fmt::format("{}/channels/{}", at, c), below = pointer + "/target";
        const json& target = object_member(all[c], "target", pointer);
        const auto node = find_whole(target, "node", below);
        const std::string path = text_member(target, "path", below);
        const std::string why = node ? obstacle(path, nodes[read.node_numbers[*node]]) : "it has no node";
        if (!why.empty()) {
            read.scene.left_out.push_back(fmt::format("channel {} of the animation: {}", c, why));
            continue;
        }
        Channel channel{read.node_numbers[*node], *property_of(path), Between::linear, {}, {}};
        const std::size_t sampler = whole_member(all[c], "sampler", pointer);
        read_sampler(document, samplers[sampler], fmt::format("{}/samplers/{}", at, sampler),
                     width_of(channel.property, nodes[channel.node]), read.budget, channel);
        if (!channel.times.empty()) channels.push_back(std::move(channel));
    }
    return channels;
}

}  // namespace mien
