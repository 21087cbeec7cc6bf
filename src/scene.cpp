// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// glTF 2.0: the tree of nodes (specification, 3.5.3), skins (3.7.3), animations (3.11) and, for what lies between two
// keys, appendix C. Letters are the appendix's: t the share of the way from key k to the next, t_d the time between
// them, v a value, a and b the tangents into and out of a key. Turns are made unit quaternions before they are used,
// since files hold them in few digits.

#include "mien/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace mien {

namespace {

using Between = Channel::Between;
using Property = Channel::Property;

// The keys on both sides of a time; the same key twice before the first and after the last.
struct Keys {
    std::size_t first = 0, second = 0;
    double t_d = 0, t = 0;
};

Keys keys_at(const std::vector<float>& times, double time) {
    const std::size_t last = times.size() - 1;
    const auto after = std::upper_bound(times.begin(), times.end(), time,
                                        [](double at, float key) { return at < static_cast<double>(key); });
    const auto next = static_cast<std::size_t>(after - times.begin());
    if (next == 0) return {0, 0, 0, 0};
    if (next > last) return {last, last, 0, 0};
    const double t_k = times[next - 1], t_d = times[next] - t_k;
    return {next - 1, next, t_d, (time - t_k) / t_d};
}

using Values = std::span<const float>;

// What a channel holds at a key.
struct Key {
    Values a, v, b;
};

Key key_of(const Channel& channel, std::size_t key) {
    const Values all(channel.values);
    const std::size_t width = all.size() / (channel.times.size() * (channel.between == Between::cubic ? 3 : 1));
    if (channel.between != Between::cubic) return {{}, all.subspan(key * width, width), {}};
    return {all.subspan(3 * key * width, width), all.subspan((3 * key + 1) * width, width),
            all.subspan((3 * key + 2) * width, width)};
}

// Appendix C.5: the cubic Hermite spline.
double hermite(double v_0, double b_0, double v_1, double a_1, const Keys& keys) {
    const double t = keys.t, t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * v_0 + keys.t_d * (t3 - 2 * t2 + t) * b_0 + (3 * t2 - 2 * t3) * v_1 +
           keys.t_d * (t3 - t2) * a_1;
}

// Component `c` of a channel between two keys, for whatever is no turn (C.2, C.3, C.5).
double component(const Channel& channel, const Keys& keys, std::size_t c) {
    const Key first = key_of(channel, keys.first);
    if (keys.first == keys.second || channel.between == Between::step) return first.v[c];
    const Key second = key_of(channel, keys.second);
    if (channel.between == Between::cubic) return hermite(first.v[c], first.b[c], second.v[c], second.a[c], keys);
    return (1 - keys.t) * double{first.v[c]} + keys.t * double{second.v[c]};
}

// One of no length turns nothing.
Quaternion unit(const Quaternion& q) {
    const double length = std::hypot(std::hypot(q.x, q.y), std::hypot(q.z, q.w));
    return length > 0 ? Quaternion{q.x / length, q.y / length, q.z / length, q.w / length} : Quaternion{};
}

Quaternion weighted(double s, const Quaternion& p, double t, const Quaternion& q) {
    return {s * p.x + t * q.x, s * p.y + t * q.y, s * p.z + t * q.z, s * p.w + t * q.w};
}

// Appendix C.4: along the shorter of the two arcs. Where the arc is so short that its sine says nothing, straight.
Quaternion slerp(const Quaternion& p, const Quaternion& q, double t) {
    const double d = p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w;
    const double sign = d < 0 ? -1 : 1;
    const double a = std::acos(std::min(std::abs(d), 1.0)), sine = std::sin(a);
    if (sine < 1e-7) return unit(weighted(1 - t, p, sign * t, q));
    return weighted(std::sin(a * (1 - t)) / sine, p, sign * std::sin(a * t) / sine, q);
}

Quaternion quaternion(Values v) {
    return unit({v[0], v[1], v[2], v[3]});
}

Quaternion rotation_at(const Channel& channel, const Keys& keys) {
    if (channel.between == Between::linear && keys.first != keys.second)
        return slerp(quaternion(key_of(channel, keys.first).v), quaternion(key_of(channel, keys.second).v), keys.t);
    return unit({component(channel, keys, 0), component(channel, keys, 1), component(channel, keys, 2),
                 component(channel, keys, 3)});
}

Vec3 vector_at(const Channel& channel, const Keys& keys) {
    return {component(channel, keys, 0), component(channel, keys, 1), component(channel, keys, 2)};
}

// What of a node moves.
struct Local {
    Vec3 translation;
    Quaternion rotation;
    Vec3 scale;
};

void play(const Channel& channel, double time, std::vector<Local>& locals, ScenePose& pose) {
    if (channel.times.empty()) return;
    const Keys keys = keys_at(channel.times, time);
    switch (channel.property) {
        case Property::translation:
            locals[channel.node].translation = vector_at(channel, keys);
            return;
        case Property::rotation:
            locals[channel.node].rotation = rotation_at(channel, keys);
            return;
        case Property::scale:
            locals[channel.node].scale = vector_at(channel, keys);
            return;
        case Property::morph_weights: {
            std::vector<float>& weights = pose.morph_weights[channel.node];
            for (std::size_t w = 0; w < weights.size(); ++w)
                weights[w] = static_cast<float>(component(channel, keys, w));
        }
    }
}

std::vector<Local> locals_at_rest(const Scene& scene) {
    std::vector<Local> locals;
    locals.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes) locals.push_back({node.translation, node.rotation, node.scale});
    return locals;
}

ScenePose still_weights(const Scene& scene) {
    ScenePose pose;
    for (const Node& node : scene.nodes) pose.morph_weights.push_back(node.morph_weights);
    return pose;
}

// Parents come first, so one pass does.
ScenePose placed(const Scene& scene, const std::vector<Local>& locals, ScenePose pose) {
    pose.worlds.reserve(scene.nodes.size());
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const Node& node = scene.nodes[n];
        const Affine local =
            node.matrix ? *node.matrix : affine_map(locals[n].translation, unit(locals[n].rotation), locals[n].scale);
        pose.worlds.push_back(node.parent ? pose.worlds[*node.parent] * local : local);
    }
    return pose;
}

}  // namespace

double duration(const Scene& scene) {
    double last = 0;
    for (const Channel& channel : scene.channels)
        if (!channel.times.empty()) last = std::max(last, static_cast<double>(channel.times.back()));
    return last;
}

ScenePose pose_at(const Scene& scene, double time) {
    std::vector<Local> locals = locals_at_rest(scene);
    ScenePose pose = still_weights(scene);
    for (const Channel& channel : scene.channels) play(channel, time, locals, pose);
    return placed(scene, locals, std::move(pose));
}

ScenePose rest_pose(const Scene& scene) {
    return placed(scene, locals_at_rest(scene), still_weights(scene));
}

std::vector<Affine> joint_maps(const Scene& /*scene*/, const SceneSkin& skin, const ScenePose& pose) {
    std::vector<Affine> maps;
    maps.reserve(skin.joints.size());
    for (std::size_t j = 0; j < skin.joints.size(); ++j)
        maps.push_back(pose.worlds[skin.joints[j]] * skin.inverse_binds[j]);
    return maps;
}

namespace {

void add_morphs(const Surface& surface, std::span<const float> weights, std::span<Vec3f> positions) {
    for (std::size_t t = 0; t < surface.morphs.size(); ++t) {
        const MorphTarget& morph = surface.morphs[t];
        if (weights[t] == 0) continue;
        for (std::size_t i = 0; i < morph.vertices.size(); ++i)
            positions[morph.vertices[i]] += weights[t] * morph.deltas[i];
    }
}

// The place of vertex v as each of its joints would carry it, weighted (3.7.3.3).
Vec3 skinned(const Surface& surface, const std::vector<Affine>& joints, std::size_t v, const Vec3& p) {
    Vec3 sum;
    for (std::size_t slot = v * surface.influences; slot < (v + 1) * surface.influences; ++slot)
        if (surface.weights[slot] > 0) sum += double{surface.weights[slot]} * moved(joints[surface.joints[slot]], p);
    return sum;
}

}  // namespace

void surface_positions(const Scene& scene, const Surface& surface, const ScenePose& pose, std::span<Vec3f> positions) {
    std::copy(surface.positions.begin(), surface.positions.end(), positions.begin());
    add_morphs(surface, pose.morph_weights[surface.node], positions);
    if (!surface.skin) {
        for (Vec3f& p : positions) p = to_float(moved(pose.worlds[surface.node], to_double(p)));
        return;
    }
    const std::vector<Affine> joints = joint_maps(scene, scene.skins[*surface.skin], pose);
    for (std::size_t v = 0; v < positions.size(); ++v)
        positions[v] = to_float(skinned(surface, joints, v, to_double(positions[v])));
}

}  // namespace mien
