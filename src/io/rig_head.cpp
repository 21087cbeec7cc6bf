// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The head in the extension MIEN_rig (docs/rig-file.md). glTF knows triangles and splits vertices at seams; the rig
// counts vertices as the head's own file does. So a head that came from another format keeps its faces beside the
// triangles that are shown.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "io/gltf_json.hpp"
#include "io/rig_arrays.hpp"
#include "io/rig_extension.hpp"

namespace mien {

namespace {

using nlohmann::json;

const std::string head_pointer = std::string(rig_pointer) + "/head";

json written_part(const Part& part) {
    return {{"name", part.name},
            {"mesh", part.mesh},
            {"primitive", part.primitive},
            {"firstVertex", part.first_vertex},
            {"vertexCount", part.vertex_count},
            {"firstFace", part.first_face},
            {"faceCount", part.face_count}};
}

void check_face_starts(const Mesh& mesh) {
    const std::string place = head_pointer + "/faceStarts";
    if (mesh.face_starts.empty() || mesh.face_starts.front() != 0) fail_at(place, "0 first", "something else");
    for (std::size_t f = 0; f < face_count(mesh); ++f)
        if (std::uint64_t{mesh.face_starts[f]} + 3 > mesh.face_starts[f + 1])
            fail_at(place, "three corners or more", fmt::format("fewer in face {}", f));
    if (mesh.face_starts.back() != mesh.face_vertices.size())
        fail_at(place, fmt::format("{} last", mesh.face_vertices.size()), fmt::format("{}", mesh.face_starts.back()));
}

void check_face_vertices(const Mesh& mesh) {
    const auto outside = [&](std::uint32_t v) { return v >= mesh.positions.size(); };
    const auto bad = std::find_if(mesh.face_vertices.begin(), mesh.face_vertices.end(), outside);
    if (bad != mesh.face_vertices.end())
        fail_at(head_pointer + "/faceVertices", fmt::format("vertices below {}", mesh.positions.size()),
                fmt::format("{} in element {}", *bad, bad - mesh.face_vertices.begin()));
}

void check_uvs(const Mesh& mesh) {
    const std::string place = head_pointer + "/cornerUvs";
    if (!mesh.corner_uvs.empty() && mesh.corner_uvs.size() != mesh.face_vertices.size())
        fail_at(place + "/count", fmt::format("0 or {}", mesh.face_vertices.size()),
                fmt::format("{}", mesh.corner_uvs.size()));
    const auto finite = [](const Vec2f& uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); };
    if (!std::all_of(mesh.corner_uvs.begin(), mesh.corner_uvs.end(), finite))
        fail_at(place, "finite numbers", "another");
}

// A number of 32 bits.
std::uint32_t number(const json& object, const char* name, const std::string& pointer) {
    const std::uint64_t value = whole_member(object, name, pointer);
    if (value > 0xFFFFFFFF) fail_at(pointer + '/' + name, "a number of 32 bits", fmt::format("{}", value));
    return static_cast<std::uint32_t>(value);
}

void check_run(std::uint64_t first, std::uint64_t count, std::size_t size, const std::string& pointer) {
    if (first + count > size)
        fail_at(pointer, fmt::format("a run within {}", size), fmt::format("{} from {}", count, first));
}

Part read_part(const json& written, const std::string& pointer, const Mesh& mesh) {
    Part part;
    part.name = text_member(written, "name", pointer);
    part.mesh = number(written, "mesh", pointer);
    part.primitive = number(written, "primitive", pointer);
    part.first_vertex = number(written, "firstVertex", pointer);
    part.vertex_count = number(written, "vertexCount", pointer);
    part.first_face = number(written, "firstFace", pointer);
    part.face_count = number(written, "faceCount", pointer);
    check_run(part.first_vertex, part.vertex_count, mesh.positions.size(), pointer + "/vertexCount");
    check_run(part.first_face, part.face_count, face_count(mesh), pointer + "/faceCount");
    return part;
}

}  // namespace

json append_head(GltfDocument& document, const Mesh& mesh) {
    json head = {{"unit", mesh.unit}, {"parts", json::array()}};
    head["faceStarts"] = append_array(document, mesh.face_starts);
    head["faceVertices"] = append_array(document, mesh.face_vertices);
    head["cornerUvs"] = append_array(document, mesh.corner_uvs);
    for (const Part& part : mesh.parts) head["parts"].push_back(written_part(part));
    return head;
}

Mesh read_head(const GltfDocument& document, const json& head, const std::vector<Vec3f>& rest) {
    Mesh mesh;
    mesh.positions = rest;
    mesh.unit = text_member(head, "unit", head_pointer);
    mesh.face_starts = read_array<std::uint32_t>(document, head, "faceStarts", head_pointer);
    mesh.face_vertices = read_array<std::uint32_t>(document, head, "faceVertices", head_pointer);
    mesh.corner_uvs = read_array<Vec2f>(document, head, "cornerUvs", head_pointer);
    check_face_starts(mesh);
    check_face_vertices(mesh);
    check_uvs(mesh);
    const json& parts = array_member(head, "parts", head_pointer);
    for (std::size_t i = 0; i < parts.size(); ++i)
        mesh.parts.push_back(read_part(parts[i], fmt::format("{}/parts/{}", head_pointer, i), mesh));
    return mesh;
}

}  // namespace mien
