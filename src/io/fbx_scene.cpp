// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Nodes and animations of an Assimp scene in a document of glTF. Assimp takes the transform of an FBX node apart into a
// chain of nodes (pivots, rotations before and after), so that an animation moves translation, rotation and scale of
// one of them each. Times are keys over the animation's ticks per second.

#include "io/fbx_scene.hpp"

#include <algorithm>
#include <array>
#include <assimp/scene.h>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/fbx_mesh.hpp"
#include "io/gltf_builder.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

using nlohmann::json;

// What is one mesh of the document on a node of it.
struct Shown {
    std::size_t node = 0;
    FbxParts parts;
};

// The document while it grows.
struct Growing {
    const aiScene& scene;
    GltfDocument document;
    std::map<std::string, std::size_t> numbers;             // of nodes by name, the first of each
    std::map<std::string, std::vector<Shown>> shown;        // by the name of their node
    std::map<FbxParts, std::optional<std::size_t>> meshes;  // of the document
    std::set<std::string> moving;                           // names of nodes that an animation moves
};

bool is_finite(const aiMatrix4x4& m) {
    for (unsigned row = 0; row < 4; ++row)
        for (unsigned column = 0; column < 4; ++column)
            if (!std::isfinite(m[row][column])) return false;
    return true;
}

json numbers_of(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

json numbers_of(const aiQuaternion& q) {
    return {q.x, q.y, q.z, q.w};
}

// A node that is animated needs its parts, any other keeps its matrix as it is.
void add_transform(const Growing& out, const aiNode& node, json& value) {
    const aiMatrix4x4& m = node.mTransformation;
    if (!is_finite(m))
        throw Error(fmt::format("fbx node {}: expected a finite transform, found another", shown(node.mName.C_Str())));
    if (m.IsIdentity()) return;
    if (out.moving.count(node.mName.C_Str()) == 0) {
        json columns = json::array();
        for (unsigned column = 0; column < 4; ++column)
            for (unsigned row = 0; row < 4; ++row) columns.push_back(m[row][column]);
        value["matrix"] = std::move(columns);
        return;
    }
    aiVector3D scale, translation;
    aiQuaternion rotation;
    m.Decompose(scale, rotation, translation);
    value["translation"] = numbers_of(translation);
    value["rotation"] = numbers_of(rotation.Normalize());
    value["scale"] = numbers_of(scale);
}

// The meshes of a node, those together that Assimp took apart by their materials.
std::vector<FbxParts> meshes_on(const Growing& out, const aiNode& node) {
    std::vector<FbxParts> all;
    for (unsigned m = 0; m < node.mNumMeshes; ++m) {
        if (node.mMeshes[m] >= out.scene.mNumMeshes) continue;
        const aiMesh* mesh = out.scene.mMeshes[node.mMeshes[m]];
        const bool goes_on = !all.empty() && all.back()[0]->mName == mesh->mName &&
                             all.back()[0]->mNumAnimMeshes == mesh->mNumAnimMeshes;
        if (!goes_on) all.emplace_back();
        all.back().push_back(mesh);
    }
    return all;
}

// The number of a mesh in the document, which several nodes may show.
std::optional<std::size_t> mesh_of(Growing& out, const FbxParts& parts) {
    const auto known = out.meshes.find(parts);
    if (known != out.meshes.end()) return known->second;
    const auto number = append_fbx_mesh(out.document, parts, out.scene.mNumMaterials);
    out.meshes.emplace(parts, number);
    return number;
}

// The first mesh hangs on the node itself, others on children of their own.
void add_shown(Growing& out, const aiNode& node, std::size_t number) {
    for (FbxParts& parts : meshes_on(out, node)) {
        const auto mesh = mesh_of(out, parts);
        if (!mesh) continue;
        std::size_t place = number;
        if (out.document.json["nodes"][number].contains("mesh")) {
            place = append_object(out.document, "nodes", {{"name", node.mName.C_Str()}});
            out.document.json["nodes"][number]["children"].push_back(place);
        }
        out.document.json["nodes"][place]["mesh"] = *mesh;
        out.shown[node.mName.C_Str()].push_back({place, std::move(parts)});
    }
}

void add_nodes(Growing& out, std::size_t root) {
    struct Open {
        const aiNode* node;
        std::size_t parent;
    };
    std::vector<Open> open{{out.scene.mRootNode, root}};
    while (!open.empty()) {
        const Open next = open.back();
        open.pop_back();
        json value = {{"name", next.node->mName.C_Str()}};
        add_transform(out, *next.node, value);
        const std::size_t number = append_object(out.document, "nodes", std::move(value));
        out.document.json["nodes"][next.parent]["children"].push_back(number);
        out.numbers.emplace(next.node->mName.C_Str(), number);
        add_shown(out, *next.node, number);
        for (unsigned c = next.node->mNumChildren; c > 0; --c) open.push_back({next.node->mChildren[c - 1], number});
    }
}

std::optional<std::size_t> find_node(const Growing& out, const std::string& name) {
    const auto at = out.numbers.find(name);
    return at == out.numbers.end() ? std::nullopt : std::optional(at->second);
}

void add_skins(Growing& out) {
    for (const auto& [name, list] : out.shown)
        for (const Shown& place : list)
            if (has_fbx_bones(place.parts))
                out.document.json["nodes"][place.node]["skin"] =
                    append_fbx_skin(out.document, place.parts, place.node,
                                    [&](const std::string& bone) { return find_node(out, bone); });
}

// Left, up and out of the face, and metres, as the file says it; a file that says nothing has y up in centimetres.
struct Axes {
    std::array<int, 3> axis{0, 1, 2};
    std::array<int, 3> sign{1, 1, 1};
    double metres = 0.01;
};

Axes axes_of(const aiScene& scene) {
    constexpr std::array names{"CoordAxis", "UpAxis", "FrontAxis"};
    Axes given;
    float unit = 1;
    if (scene.mMetaData == nullptr) return given;
    std::set<int> different;
    for (std::size_t k = 0; k < 3; ++k) {
        int axis = given.axis[k], sign = 1;
        scene.mMetaData->Get(names[k], axis);
        scene.mMetaData->Get(std::string(names[k]) + "Sign", sign);
        given.axis[k] = axis;
        given.sign[k] = sign < 0 ? -1 : 1;
        if (axis >= 0 && axis < 3) different.insert(axis);
    }
    if (different.size() != 3) given = {};
    if (scene.mMetaData->Get("UnitScaleFactor", unit) && std::isfinite(unit) && unit > 0)
        given.metres = 0.01 * double{unit};
    return given;
}

std::size_t append_root(GltfDocument& document, const aiScene& scene) {
    const Axes axes = axes_of(scene);
    std::array<double, 16> columns{};
    columns[15] = 1;
    for (std::size_t k = 0; k < 3; ++k)
        columns[4 * static_cast<std::size_t>(axes.axis[k]) + k] = axes.sign[k] * axes.metres;
    return append_object(document, "nodes", {{"name", "fbx"}, {"matrix", columns}});
}

void add_material(GltfDocument& document, const aiMaterial* material) {
    aiColor4D colour(0.8F, 0.8F, 0.8F, 1);
    aiString name;
    if (material != nullptr) {
        material->Get(AI_MATKEY_COLOR_DIFFUSE, colour);
        material->Get(AI_MATKEY_NAME, name);
    }
    const auto share = [](float x) { return std::isfinite(x) ? std::clamp(x, 0.0F, 1.0F) : 0.8F; };
    const json surface = {{"baseColorFactor", {share(colour.r), share(colour.g), share(colour.b), 1.0}},
                          {"metallicFactor", 0.0},
                          {"roughnessFactor", 0.7}};
    append_object(document, "materials",
                  {{"name", name.C_Str()}, {"doubleSided", true}, {"pbrMetallicRoughness", surface}});
}

// One more than the file has: the last is that of meshes that name none.
void add_materials(Growing& out) {
    for (unsigned m = 0; m < out.scene.mNumMaterials; ++m) add_material(out.document, out.scene.mMaterials[m]);
    add_material(out.document, nullptr);
}

// An animation while it grows.
struct Playing {
    Growing& out;
    double ticks = 1;  // per second
    json channels = json::array(), samplers = json::array();
};

void add_channel(Playing& playing, std::size_t node, const char* path, const std::vector<float>& times,
                 const std::vector<float>& values, Elements elements) {
    if (times.empty()) return;
    const auto finite = [](float x) { return std::isfinite(x); };
    if (!std::all_of(times.begin(), times.end(), finite) || !std::all_of(values.begin(), values.end(), finite))
        throw Error(fmt::format("fbx animation of node {}: expected finite keys of {}, found others",
                                shown(playing.out.document.json["nodes"][node]["name"].get<std::string>()), path));
    const std::size_t input =
        append_floats(playing.out.document, times, Elements::scalar, BufferTarget::none, Bounds::given);
    const std::size_t output = append_floats(playing.out.document, values, elements, BufferTarget::none);
    playing.channels.push_back({{"sampler", playing.samplers.size()}, {"target", {{"node", node}, {"path", path}}}});
    playing.samplers.push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
}

void add_vectors(Playing& playing, std::size_t node, const char* path, const aiVectorKey* keys, unsigned count) {
    std::vector<float> times, values;
    for (unsigned k = 0; k < count; ++k) {
        times.push_back(static_cast<float>(keys[k].mTime / playing.ticks));
        values.insert(values.end(), {keys[k].mValue.x, keys[k].mValue.y, keys[k].mValue.z});
    }
    add_channel(playing, node, path, times, values, Elements::vec3);
}

void add_node_channels(Playing& playing, const aiNodeAnim& moves) {
    const auto node = find_node(playing.out, moves.mNodeName.C_Str());
    if (!node) return;
    add_vectors(playing, *node, "translation", moves.mPositionKeys, moves.mNumPositionKeys);
    std::vector<float> times, values;
    for (unsigned k = 0; k < moves.mNumRotationKeys; ++k) {
        const aiQuaternion& q = moves.mRotationKeys[k].mValue;
        times.push_back(static_cast<float>(moves.mRotationKeys[k].mTime / playing.ticks));
        values.insert(values.end(), {q.x, q.y, q.z, q.w});
    }
    add_channel(playing, *node, "rotation", times, values, Elements::vec4);
    add_vectors(playing, *node, "scale", moves.mScalingKeys, moves.mNumScalingKeys);
}

// The keys of one shape: weights over seconds.
using ShapeKeys = std::map<double, double>;

double weight_at(const ShapeKeys& keys, double time) {
    if (keys.empty()) return 0;
    const auto after = keys.lower_bound(time);
    if (after == keys.end()) return keys.rbegin()->second;
    if (after == keys.begin() || after->first == time) return after->second;
    const auto before = std::prev(after);
    const double t = (time - before->first) / (after->first - before->first);
    return (1 - t) * before->second + t * after->second;
}

// Every shape has keys of its own, while a track of glTF has one value of each at all its keys.
void add_shape_channel(Playing& playing, const aiMeshMorphAnim& moves, const Shown& place) {
    std::vector<ShapeKeys> shapes(place.parts[0]->mNumAnimMeshes);
    std::set<double> all;
    for (unsigned k = 0; k < moves.mNumKeys; ++k) {
        const aiMeshMorphKey& key = moves.mKeys[k];
        const double time = key.mTime / playing.ticks;
        if (!std::isfinite(time)) continue;
        for (unsigned i = 0; i < key.mNumValuesAndWeights; ++i)
            if (key.mValues[i] < shapes.size()) shapes[key.mValues[i]][time] = key.mWeights[i];
        all.insert(time);
    }
    std::vector<float> times, values;
    for (const double time : all) {
        times.push_back(static_cast<float>(time));
        for (const ShapeKeys& shape : shapes) values.push_back(static_cast<float>(weight_at(shape, time)));
    }
    if (!shapes.empty()) add_channel(playing, place.node, "weights", times, values, Elements::scalar);
}

// The channel is called by the node, a star and the number of the geometry on it.
void add_shape_channels(Playing& playing, const aiMeshMorphAnim& moves) {
    const std::string name = moves.mName.C_Str();
    const auto at = playing.out.shown.find(name.substr(0, name.rfind('*')));
    if (at == playing.out.shown.end()) return;
    for (const Shown& place : at->second) add_shape_channel(playing, moves, place);
}

void add_animation(Growing& out, const aiAnimation& animation) {
    constexpr double ticks_where_none_are_stated = 25;
    Playing playing{out, animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : ticks_where_none_are_stated};
    for (unsigned c = 0; c < animation.mNumChannels; ++c) add_node_channels(playing, *animation.mChannels[c]);
    for (unsigned c = 0; c < animation.mNumMorphMeshChannels; ++c)
        add_shape_channels(playing, *animation.mMorphMeshChannels[c]);
    if (playing.channels.empty()) return;
    append_object(out.document, "animations",
                  {{"name", animation.mName.C_Str()},
                   {"samplers", std::move(playing.samplers)},
                   {"channels", std::move(playing.channels)}});
}

void find_moving(Growing& out) {
    for (unsigned a = 0; a < out.scene.mNumAnimations; ++a)
        for (unsigned c = 0; c < out.scene.mAnimations[a]->mNumChannels; ++c)
            out.moving.insert(out.scene.mAnimations[a]->mChannels[c]->mNodeName.C_Str());
}

}  // namespace

GltfDocument document_of(const aiScene& scene) {
    Growing out{scene, {}, {}, {}, {}, {}};
    if (scene.mRootNode == nullptr) throw Error("fbx: expected a scene with nodes, found none");
    out.document.json["asset"]["version"] = "2.0";
    find_moving(out);
    add_materials(out);
    const std::size_t root = append_root(out.document, scene);
    add_nodes(out, root);
    add_skins(out);
    for (unsigned a = 0; a < scene.mNumAnimations; ++a) add_animation(out, *scene.mAnimations[a]);
    out.document.json["scene"] = 0;
    json shown_scene;
    shown_scene["nodes"].push_back(root);
    out.document.json["scenes"].push_back(std::move(shown_scene));
    return std::move(out.document);
}

}  // namespace mien
