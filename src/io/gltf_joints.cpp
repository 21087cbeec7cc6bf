// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A take as an animation of joints (glTF 2.0 specification, 3.11): one key time per row, shared by all tracks; tracks
// that never leave the rest of their node are not written. The head's motion is that of the node above all joints, so
// a joint stands at head pose * own pose, and the skin follows. What example shapes add is morph targets, which act on
// the neutral head before the joints do; joints of points only translate, so nothing turns a target.

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "io/gltf_builder.hpp"
#include "io/gltf_keys.hpp"
#include "io/gltf_morphs.hpp"
#include "io/gltf_skin.hpp"

#include "mien/io/gltf.hpp"

namespace mien {

namespace {

using nlohmann::json;

// What a node does over time: `rest` at every key where nothing moves.
struct Track {
    std::size_t node;
    const char* path;
    std::vector<float> rest;
    std::vector<float> values;
};

bool stays(const Track& track) {
    for (std::size_t i = 0; i < track.values.size(); ++i)
        if (track.values[i] != track.rest[i % track.rest.size()]) return false;
    return true;
}

// A joint of a point translates; an eyeball turns.
std::vector<Track> joint_tracks(const Rig& rig, const Take& take, const Keys& keys, const JointNodes& nodes) {
    std::vector<Track> tracks;
    for (std::size_t j = 0; j < nodes.joints.size(); ++j) {
        const Vec3f origin = written_origin(rig, j);
        if (j <= rig.points.size())
            tracks.push_back({nodes.joints[j], "translation", {origin.x, origin.y, origin.z}, {}});
        else
            tracks.push_back({nodes.joints[j], "rotation", {0, 0, 0, 1}, {}});
    }
    const TakeBinding binding = bind_take(rig, take);
    std::vector<Vec3f> moved(rig.points.size());
    std::vector<Pose> poses(joint_count(rig));
    for (const std::size_t r : keys.rows) {
        displacements(rig, binding, row(take, r), moved);
        joint_poses(rig, moved, poses);
        for (std::size_t j = 0; j < tracks.size(); ++j) {
            const Vec3 origin = to_double(written_origin(rig, j));
            if (j <= rig.points.size())
                append_translation(tracks[j].values, origin + poses[j].translation);
            else
                append_rotation(tracks[j].values, poses[j].rotation);
        }
    }
    return tracks;
}

std::vector<Track> head_tracks(const Take& take, const Keys& keys, const JointNodes& nodes) {
    Track rotation{nodes.root, "rotation", {0, 0, 0, 1}, {}}, translation{nodes.root, "translation", {0, 0, 0}, {}};
    for (const std::size_t r : keys.rows) {
        append_rotation(rotation.values, take.head[r].rotation);
        append_translation(translation.values, take.head[r].translation);
    }
    return {std::move(rotation), std::move(translation)};
}

// How much of every shape of the prior each row of the take shows.
std::vector<float> prior_weights(const Rig& rig, const Take& take) {
    const std::size_t shapes = rig.prior->shapes.size();
    const TakeBinding binding = bind_take(rig, take);
    std::vector<Vec3f> moved(rig.points.size());
    std::vector<float> weights(row_count(take) * shapes);
    for (std::size_t r = 0; r < row_count(take); ++r) {
        displacements(rig, binding, row(take, r), moved);
        shape_weights(*rig.prior, moved, std::span(weights).subspan(r * shapes, shapes));
    }
    return weights;
}

std::vector<Track> shape_tracks(const Rig& rig, const Take& take, const Keys& keys,
                                const std::vector<MorphedMesh>& meshes) {
    const std::vector<float> weights = prior_weights(rig, take);
    std::vector<Track> tracks;
    tracks.reserve(meshes.size());
    for (const MorphedMesh& mesh : meshes)
        tracks.push_back({mesh.node, "weights", std::vector<float>(mesh.targets.size()),
                          weights_at_keys(mesh, weights, rig.prior->shapes.size(), keys)});
    return tracks;
}

Elements elements_of(const Track& track) {
    if (std::string_view(track.path) == "weights") return Elements::scalar;
    return track.rest.size() == 4 ? Elements::vec4 : Elements::vec3;
}

void append_animation(GltfDocument& document, const Keys& keys, const std::vector<Track>& tracks) {
    if (std::all_of(tracks.begin(), tracks.end(), stays)) return;
    const std::size_t input = append_floats(document, keys.times, Elements::scalar, BufferTarget::none, Bounds::given);
    json samplers = json::array(), channels = json::array();
    for (const Track& track : tracks) {
        if (stays(track)) continue;
        const std::size_t output = append_floats(document, track.values, elements_of(track), BufferTarget::none);
        channels.push_back({{"sampler", samplers.size()}, {"target", {{"node", track.node}, {"path", track.path}}}});
        samplers.push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
    }
    append_object(document, "animations",
                  {{"name", "take"}, {"samplers", std::move(samplers)}, {"channels", std::move(channels)}});
}

}  // namespace

std::vector<std::byte> format_glb(const Mesh& mesh, const Rig& rig, const Skin& skin, const Take& take,
                                  const GltfOptions& options) {
    BaseDocument base = base_document(mesh);
    const JointNodes nodes = append_skin(base, rig, skin);
    const Keys keys = keys_of(take.times);
    std::vector<Track> tracks = joint_tracks(rig, take, keys, nodes);
    if (rig.prior) {
        const std::vector<MorphedMesh> meshes = append_morphs(base, vertex_count(mesh), rig.prior->shapes);
        std::vector<Track> shapes = shape_tracks(rig, take, keys, meshes);
        std::move(shapes.begin(), shapes.end(), std::back_inserter(tracks));
    }
    if (options.head_motion && !take.head.empty()) {
        std::vector<Track> head = head_tracks(take, keys, nodes);
        std::move(head.begin(), head.end(), std::back_inserter(tracks));
    }
    append_animation(base.document, keys, tracks);
    return format_glb(base.document);
}

}  // namespace mien
