// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// When there are rows: an animation that was baked has a key for every frame in every channel, and then those are the
// rows. Where channels have keys of their own, thinned out by an exporter, rows lie evenly at the rate of the densest;
// an animation of few keys says nothing about frames.

#include "io/scene_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <memory>
#include <utility>

#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

using Property = Channel::Property;

constexpr double usual_rate = 30;  // rows per second of what has few keys
constexpr double least_dense = 8;  // keys per second of an animation that was baked

struct Span {
    double first = 0, last = 0;
};

Span span_of(const Scene& scene) {
    Span span{scene.channels.front().times.front(), scene.channels.front().times.back()};
    for (const Channel& channel : scene.channels) {
        span.first = std::min(span.first, double{channel.times.front()});
        span.last = std::max(span.last, double{channel.times.back()});
    }
    return span;
}

double keys_per_second(const Channel& channel) {
    const double seconds = double{channel.times.back()} - double{channel.times.front()};
    return seconds > 0 ? static_cast<double>(channel.times.size() - 1) / seconds : 0;
}

const Channel& densest(const Scene& scene) {
    return *std::max_element(scene.channels.begin(), scene.channels.end(),
                             [](const Channel& a, const Channel& b) { return a.times.size() < b.times.size(); });
}

// Whether every key of `channel` is one of `times`, but for rounding.
bool has_keys_among(const Channel& channel, const std::vector<float>& times, double rounding) {
    return std::all_of(channel.times.begin(), channel.times.end(), [&](float time) {
        const auto after = std::lower_bound(times.begin(), times.end(), time);
        const auto near = [&](auto at) { return std::abs(double{*at} - double{time}) <= rounding; };
        return (after != times.end() && near(after)) || (after != times.begin() && near(after - 1));
    });
}

// The keys as rows, seconds from the first; nothing where they lie apart or are few.
std::vector<double> baked_times(const Scene& scene) {
    const std::vector<float>& keys = densest(scene).times;
    const double rate = keys_per_second(densest(scene));
    std::vector<double> times;
    if (rate < least_dense) return times;
    for (const Channel& channel : scene.channels)
        if (!has_keys_among(channel, keys, 0.01 / rate)) return times;
    for (const float key : keys)
        if (const double time = double{key} - double{keys.front()}; times.empty() || time > times.back())
            times.push_back(time);
    return times;
}

// How many rows lie evenly in so many seconds, their ends among them; a whole number.
double even_rows(double seconds, double rate) {
    constexpr double rounding = 1e-4;
    return std::floor(seconds * rate + rounding) + 1;
}

std::vector<double> even_times(double seconds, double rate) {
    constexpr double most = 1e6;
    const double rows = even_rows(seconds, rate);
    if (!(rows <= most))
        throw Error(fmt::format("animation: expected at most {} rows, found {:.0f}: {} s at {} rows a second", most,
                                rows, seconds, rate));
    std::vector<double> times(static_cast<std::size_t>(rows));
    for (std::size_t row = 0; row < times.size(); ++row) times[row] = static_cast<double>(row) / rate;
    return times;
}

// Rows per second of an animation whose keys are no rows.
double even_rate(const Scene& scene) {
    const double of_keys = keys_per_second(densest(scene));
    return of_keys < least_dense ? usual_rate : of_keys;
}

// Seconds from the first key on.
std::vector<double> row_times(const Scene& scene, double rate) {
    if (!std::isfinite(rate) || rate < 0)
        throw Error(fmt::format("rate: expected a number of rows per second above 0, found {}", rate));
    const Span span = span_of(scene);
    if (rate > 0) return even_times(span.last - span.first, rate);
    std::vector<double> times = baked_times(scene);
    return times.empty() ? even_times(span.last - span.first, even_rate(scene)) : times;
}

// Numbers of one value of the channel.
std::size_t width_of(const Channel& channel) {
    return channel.values.size() / (channel.times.size() * (channel.between == Channel::Between::cubic ? 3 : 1));
}

// Whether number `c` of the values is another at some time than at the first key.
bool changes(const Channel& channel, std::size_t c) {
    const std::size_t width = width_of(channel);
    if (channel.between != Channel::Between::cubic) {
        for (std::size_t at = c; at < channel.values.size(); at += width)
            if (channel.values[at] != channel.values[c]) return true;
        return false;
    }
    for (std::size_t k = 0; k < channel.times.size(); ++k) {
        const std::size_t at = 3 * k * width + c;
        if (channel.values[at] != 0 || channel.values[at + 2 * width] != 0 ||
            channel.values[at + width] != channel.values[width + c])
            return true;
    }
    return false;
}

bool changes(const Channel& channel) {
    for (std::size_t c = 0; c < width_of(channel); ++c)
        if (changes(channel, c)) return true;
    return false;
}

std::string called(const std::string& name, const char* what, std::size_t number) {
    return name.empty() ? fmt::format("{} {}", what, number) : name;
}

void add_once(std::vector<std::string>& names, std::string name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
}

// Which nodes a channel moves, themselves or with a parent.
struct Moving {
    std::vector<bool> itself, carried;
};

Moving moving_nodes(const Scene& scene) {
    Moving moving;
    moving.itself.resize(scene.nodes.size());
    for (const Channel& channel : scene.channels)
        if (channel.property != Property::morph_weights && changes(channel)) moving.itself[channel.node] = true;
    moving.carried = moving.itself;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        if (scene.nodes[n].parent && moving.carried[*scene.nodes[n].parent]) moving.carried[n] = true;
    return moving;
}

// The names of the shapes of a node whose weights a channel changes; copies on further surfaces are called alike.
void add_morphs(const Scene& scene, const Channel& channel, std::vector<std::string>& morphs) {
    const auto surface = std::find_if(scene.surfaces.begin(), scene.surfaces.end(),
                                      [&](const Surface& s) { return s.node == channel.node; });
    if (surface == scene.surfaces.end()) return;
    for (std::size_t t = 0; t < surface->morphs.size(); ++t)
        if (changes(channel, t)) add_once(morphs, surface->morphs[t].name);
}

bool hangs_on(const Scene& scene, const Surface& surface, const std::vector<bool>& moving) {
    if (!surface.skin) return false;
    const std::vector<std::uint32_t>& joints = scene.skins[*surface.skin].joints;
    return std::any_of(joints.begin(), joints.end(), [&](std::uint32_t joint) { return moving[joint]; });
}

// A sequence's own state: what a row is worked out from.
struct Playing {
    Scene scene;
    std::vector<Vec3f> rest;  // of the mesh
    double first = 0;         // seconds, of row 0
};

void fill(const Playing& playing, double time, std::size_t row, std::span<Vec3f> positions) {
    std::copy(playing.rest.begin(), playing.rest.end(), positions.begin());
    const ScenePose pose = pose_at(playing.scene, playing.first + time);
    std::vector<Vec3f> own;
    for (const Surface& surface : playing.scene.surfaces) {
        own.resize(surface.positions.size());
        surface_positions(playing.scene, surface, pose, own);
        for (std::size_t v = 0; v < own.size(); ++v) positions[surface.mesh_vertices[v]] = own[v];
    }
    for (std::size_t v = 0; v < positions.size(); ++v)
        if (!is_finite(positions[v]))
            throw Error(fmt::format("row {}, vertex {}: expected a finite position, found one that runs over", row, v));
}

}  // namespace

std::size_t find_animation(std::span<const std::string> names, const std::string& wanted) {
    if (names.empty()) throw Error("expected an animation, found none");
    if (wanted.empty()) return 0;
    const auto at = std::find(names.begin(), names.end(), wanted);
    if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
    const auto number = parse_integer(wanted);
    if (number && *number >= 0 && static_cast<std::uint64_t>(*number) < names.size())
        return static_cast<std::size_t>(*number);
    constexpr std::size_t most_shown = 8;
    std::string all;
    for (std::size_t a = 0; a < std::min(names.size(), most_shown); ++a)
        all += fmt::format("{}{} {}", a > 0 ? ", " : "", a, shown(names[a]));
    throw Error(fmt::format("animation {}: expected one of {} ({}{})", shown(wanted), names.size(), all,
                            names.size() > most_shown ? ", ..." : ""));
}

Animation describe_animation(const Scene& scene, std::string name) {
    Animation animation;
    animation.name = std::move(name);
    if (scene.channels.empty()) return animation;
    const Span span = span_of(scene);
    const std::vector<double> baked = baked_times(scene);
    animation.start = span.first;
    animation.seconds = span.last - span.first;
    animation.rate = baked.empty() ? even_rate(scene) : keys_per_second(densest(scene));
    animation.rows = baked.empty()
                         ? static_cast<std::uint64_t>(std::min(even_rows(animation.seconds, animation.rate), 1e18))
                         : baked.size();
    const Moving moving = moving_nodes(scene);
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        if (moving.itself[n]) add_once(animation.nodes, called(scene.nodes[n].name, "node", n));
    for (const Channel& channel : scene.channels)
        if (channel.property == Property::morph_weights) add_morphs(scene, channel, animation.morphs);
    for (const Surface& surface : scene.surfaces)
        if (hangs_on(scene, surface, moving.carried))
            add_once(animation.skins, called(surface.name, "mesh", surface.mesh));
    return animation;
}

MeshSequence sequence_of(Mesh mesh, Scene scene, double rate) {
    if (scene.channels.empty()) throw Error("animation: expected one that moves the head, found none");
    std::vector<double> times = row_times(scene, rate);
    const double first = span_of(scene).first;
    const auto playing = std::make_shared<const Playing>(Playing{std::move(scene), mesh.positions, first});
    return {std::move(mesh), times, [playing, times](std::size_t row, std::span<Vec3f> positions) {
                fill(*playing, times[row], row, positions);
            }};
}

}  // namespace mien
