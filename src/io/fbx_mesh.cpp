// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Assimp gives a vertex for every corner of every face. Corners that are equal in all that they hold become one vertex
// again, in the order in which faces first name them.

#include "io/fbx_mesh.hpp"

#include <algorithm>
#include <array>
#include <assimp/mesh.h>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "io/gltf_builder.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

using nlohmann::json;

constexpr std::size_t most_influences = 8;

[[noreturn]] void fail_in(const aiMesh& mesh, const std::string& expected, const std::string& found) {
    throw Error(fmt::format("fbx mesh {}: expected {}, found {}", shown(mesh.mName.C_Str()), expected, found));
}

Vec3f vector_of(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

Vec3f place(const aiMesh& mesh, const aiVector3D& v, std::size_t vertex) {
    const Vec3f p = vector_of(v);
    if (!is_finite(p)) fail_in(mesh, "finite positions", fmt::format("vertex {} at {} {} {}", vertex, p.x, p.y, p.z));
    return p;
}

// What of a mesh all its vertices have, in numbers that can be used.
struct Attributes {
    bool normals = false, uvs = false;
};

Attributes attributes_of(const aiMesh& mesh) {
    Attributes result{mesh.mNormals != nullptr, mesh.mTextureCoords[0] != nullptr};
    for (std::size_t v = 0; v < mesh.mNumVertices; ++v) {
        result.normals =
            result.normals && is_finite(vector_of(mesh.mNormals[v])) && length(vector_of(mesh.mNormals[v])) > 0;
        result.uvs = result.uvs && is_finite(vector_of(mesh.mTextureCoords[0][v]));
    }
    return result;
}

struct Influence {
    std::uint16_t joint = 0;
    float weight = 0;
};
using Influences = std::vector<std::vector<Influence>>;  // per vertex, the heaviest first

// The bones of all parts, each once by its name.
using Bones = std::vector<const aiBone*>;
Bones bones_of(const FbxParts& parts) {
    Bones bones;
    std::unordered_set<std::string> names;
    for (const aiMesh* part : parts)
        for (unsigned b = 0; b < part->mNumBones; ++b)
            if (names.insert(part->mBones[b]->mName.C_Str()).second) bones.push_back(part->mBones[b]);
    constexpr std::size_t most = 65535;
    if (bones.size() > most) fail_in(*parts[0], fmt::format("at most {} bones", most), std::to_string(bones.size()));
    return bones;
}

void add_influences(const aiMesh& mesh, const aiBone& bone, std::size_t joint, Influences& all) {
    for (unsigned w = 0; w < bone.mNumWeights; ++w) {
        const aiVertexWeight& given = bone.mWeights[w];
        if (given.mVertexId >= mesh.mNumVertices)
            fail_in(mesh, fmt::format("vertices below {} in bone {}", mesh.mNumVertices, shown(bone.mName.C_Str())),
                    std::to_string(given.mVertexId));
        if (std::isfinite(given.mWeight) && given.mWeight > 0)
            all[given.mVertexId].push_back({static_cast<std::uint16_t>(joint), given.mWeight});
    }
}

// Vertices on no bone hang on the node that shows the mesh, which is the joint behind all bones.
Influences influences_of(const aiMesh& mesh, const Bones& bones) {
    Influences all(bones.empty() ? 0 : mesh.mNumVertices);
    std::unordered_map<std::string, std::size_t> joints;
    for (const aiBone* bone : bones) joints.emplace(bone->mName.C_Str(), joints.size());
    for (unsigned b = 0; b < mesh.mNumBones; ++b)
        add_influences(mesh, *mesh.mBones[b], joints.at(mesh.mBones[b]->mName.C_Str()), all);
    for (std::vector<Influence>& one : all) {
        std::stable_sort(one.begin(), one.end(),
                         [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
        if (one.size() > most_influences) one.resize(most_influences);
        if (one.empty()) one.push_back({static_cast<std::uint16_t>(bones.size()), 1});
    }
    return all;
}

// The vertices that are kept: for each its number in Assimp's mesh, and three corners a triangle.
struct Joined {
    std::vector<std::uint32_t> vertices, corners;
};

void append_bytes_of(std::string& key, const Vec3f& v) {
    std::array<char, sizeof v> bytes{};
    std::memcpy(bytes.data(), &v, sizeof v);
    key.append(bytes.data(), bytes.size());
}

// All that a vertex holds.
std::string key_of(const aiMesh& mesh, const Attributes& has, const Influences& influences, std::uint32_t v) {
    std::string key;
    append_bytes_of(key, vector_of(mesh.mVertices[v]));
    if (has.normals) append_bytes_of(key, vector_of(mesh.mNormals[v]));
    if (has.uvs) append_bytes_of(key, vector_of(mesh.mTextureCoords[0][v]));
    for (unsigned t = 0; t < mesh.mNumAnimMeshes; ++t)
        append_bytes_of(key, vector_of(mesh.mAnimMeshes[t]->mVertices[v]));
    if (!influences.empty())
        for (const Influence& one : influences[v]) append_bytes_of(key, {static_cast<float>(one.joint), one.weight, 0});
    return key;
}

Joined joined(const aiMesh& mesh, const Attributes& has, const Influences& influences) {
    Joined result;
    std::unordered_map<std::string, std::uint32_t> known;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        if (face.mNumIndices != 3) continue;
        for (unsigned c = 0; c < 3; ++c) {
            const std::uint32_t v = face.mIndices[c];
            if (v >= mesh.mNumVertices)
                fail_in(mesh, fmt::format("corners below {} in face {}", mesh.mNumVertices, f), std::to_string(v));
            const auto next = static_cast<std::uint32_t>(result.vertices.size());
            const auto [at, is_new] = known.emplace(key_of(mesh, has, influences, v), next);
            if (is_new) result.vertices.push_back(v);
            result.corners.push_back(at->second);
        }
    }
    return result;
}

void check_shapes(const aiMesh& mesh) {
    for (unsigned t = 0; t < mesh.mNumAnimMeshes; ++t) {
        const aiAnimMesh& shape = *mesh.mAnimMeshes[t];
        if (shape.mVertices == nullptr || shape.mNumVertices != mesh.mNumVertices)
            fail_in(mesh, fmt::format("{} vertices in shape {}", mesh.mNumVertices, shown(shape.mName.C_Str())),
                    std::to_string(shape.mVertices == nullptr ? 0 : shape.mNumVertices));
    }
}

std::size_t append_positions(GltfDocument& document, const aiMesh& mesh, const Joined& kept) {
    std::vector<Vec3f> positions;
    for (const std::uint32_t v : kept.vertices) positions.push_back(place(mesh, mesh.mVertices[v], v));
    return append_vectors(document, positions, BufferTarget::vertices, Bounds::given);
}

std::size_t append_normals(GltfDocument& document, const aiMesh& mesh, const Joined& kept) {
    std::vector<Vec3f> normals;
    for (const std::uint32_t v : kept.vertices) {
        const Vec3f n = vector_of(mesh.mNormals[v]);
        normals.push_back(n / length(n));
    }
    return append_vectors(document, normals, BufferTarget::vertices);
}

std::size_t append_uvs(GltfDocument& document, const aiMesh& mesh, const Joined& kept) {
    std::vector<float> uvs;
    for (const std::uint32_t v : kept.vertices)
        uvs.insert(uvs.end(), {mesh.mTextureCoords[0][v].x, 1 - mesh.mTextureCoords[0][v].y});
    return append_floats(document, uvs, Elements::vec2, BufferTarget::vertices);
}

std::size_t append_shape(GltfDocument& document, const aiMesh& mesh, const aiAnimMesh& shape, const Joined& kept) {
    std::vector<Vec3f> deltas;
    for (const std::uint32_t v : kept.vertices)
        deltas.push_back(place(mesh, shape.mVertices[v], v) - vector_of(mesh.mVertices[v]));
    return append_vectors(document, deltas, BufferTarget::vertices, Bounds::given);
}

// Four joints and weights a vertex in every set; weights of a vertex add up to 1.
void append_joints(GltfDocument& document, json& attributes, const Influences& influences, const Joined& kept) {
    std::size_t most = 0;
    for (const std::uint32_t v : kept.vertices) most = std::max(most, influences[v].size());
    for (std::size_t first = 0; first < most; first += 4) {
        std::vector<std::uint16_t> joints;
        std::vector<float> weights;
        for (const std::uint32_t v : kept.vertices) {
            double sum = 0;
            for (const Influence& one : influences[v]) sum += double{one.weight};
            for (std::size_t k = first; k < first + 4; ++k) {
                const Influence one = k < influences[v].size() ? influences[v][k] : Influence{};
                joints.push_back(one.joint);
                weights.push_back(static_cast<float>(one.weight / sum));
            }
        }
        attributes[fmt::format("JOINTS_{}", first / 4)] =
            append_shorts(document, joints, Elements::vec4, BufferTarget::vertices);
        attributes[fmt::format("WEIGHTS_{}", first / 4)] =
            append_floats(document, weights, Elements::vec4, BufferTarget::vertices);
    }
}

json targets_of(GltfDocument& document, const aiMesh& mesh, const Joined& kept) {
    json targets = json::array();
    for (unsigned t = 0; t < mesh.mNumAnimMeshes; ++t) {
        json target;
        target["POSITION"] = append_shape(document, mesh, *mesh.mAnimMeshes[t], kept);
        targets.push_back(std::move(target));
    }
    return targets;
}

// Nothing where the part has no triangles.
std::optional<json> primitive_of(GltfDocument& document, const aiMesh& mesh, const Bones& bones) {
    check_shapes(mesh);
    const Attributes has = attributes_of(mesh);
    const Influences influences = influences_of(mesh, bones);
    const Joined kept = joined(mesh, has, influences);
    if (kept.corners.empty()) return std::nullopt;
    json primitive;
    json& attributes = primitive["attributes"];
    attributes["POSITION"] = append_positions(document, mesh, kept);
    if (has.normals) attributes["NORMAL"] = append_normals(document, mesh, kept);
    if (has.uvs) attributes["TEXCOORD_0"] = append_uvs(document, mesh, kept);
    if (!influences.empty()) append_joints(document, attributes, influences, kept);
    primitive["indices"] = append_indices(document, kept.corners);
    if (mesh.mNumAnimMeshes > 0) primitive["targets"] = targets_of(document, mesh, kept);
    return primitive;
}

}  // namespace

std::optional<std::size_t> append_fbx_mesh(GltfDocument& document, const FbxParts& parts, std::size_t materials) {
    const Bones bones = bones_of(parts);
    json primitives = json::array(), names = json::array();
    for (const aiMesh* part : parts) {
        std::optional<json> primitive = primitive_of(document, *part, bones);
        if (!primitive) continue;
        (*primitive)["material"] = std::min<std::size_t>(part->mMaterialIndex, materials);
        primitives.push_back(std::move(*primitive));
    }
    if (primitives.empty()) return std::nullopt;
    json value;
    value["name"] = parts[0]->mName.C_Str();
    value["primitives"] = std::move(primitives);
    for (unsigned t = 0; t < parts[0]->mNumAnimMeshes; ++t) names.push_back(parts[0]->mAnimMeshes[t]->mName.C_Str());
    if (!names.empty()) value["extras"]["targetNames"] = std::move(names);
    return append_object(document, "meshes", std::move(value));
}

bool has_fbx_bones(const FbxParts& parts) {
    return std::any_of(parts.begin(), parts.end(), [](const aiMesh* part) { return part->mNumBones > 0; });
}

std::size_t append_fbx_skin(GltfDocument& document, const FbxParts& parts, std::size_t node,
                            const std::function<std::optional<std::size_t>(const std::string& bone)>& node_of) {
    json joints = json::array();
    std::vector<float> binds;
    const auto add = [&](std::size_t joint, const aiMatrix4x4& bind) {
        joints.push_back(joint);
        for (unsigned column = 0; column < 4; ++column)
            for (unsigned row = 0; row < 4; ++row) binds.push_back(bind[row][column]);
    };
    for (const aiBone* bone : bones_of(parts)) {
        const auto joint = node_of(bone->mName.C_Str());
        add(joint.value_or(node), joint ? bone->mOffsetMatrix : aiMatrix4x4());
    }
    add(node, aiMatrix4x4());
    if (!std::all_of(binds.begin(), binds.end(), [](float x) { return std::isfinite(x); }))
        fail_in(*parts[0], "finite matrices of its bones", "one that is not");
    const std::size_t matrices = append_floats(document, binds, Elements::mat4, BufferTarget::none);
    return append_object(document, "skins", {{"joints", std::move(joints)}, {"inverseBindMatrices", matrices}});
}

}  // namespace mien
