// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <tuple>

#include "write_surfaces.hpp"

#include "mien/io/png.hpp"

namespace mien::samples {
namespace {

// One corner's vertex: the part's vertex, and its texture coordinate in steps of 1/65536 so that equal ones are found.
struct Corner {
    std::uint32_t vertex = 0;
    std::int64_t u = 0, v = 0;
    friend bool operator<(const Corner& a, const Corner& b) {
        return std::tie(a.vertex, a.u, a.v) < std::tie(b.vertex, b.u, b.v);
    }
};

struct Primitive {
    std::vector<Corner> vertices;
    std::vector<std::uint16_t> indices;
    std::uint32_t material = 0;
};

Corner corner_of(const SurfaceFace& face, std::size_t k) {
    return {face.corners[k], std::llround(face.uvs[k].u * 65536), std::llround(face.uvs[k].v * 65536)};
}

class PrimitiveMaker {
public:
    PrimitiveMaker(const Surface& part, std::uint32_t material) : part_(part) {
        result_.material = material;
        if (part.materials.size() == 1) keep_part_order();
        for (const SurfaceFace& face : part.faces)
            if (face.material == material) add(face);
    }
    const Primitive& result() const { return result_; }

private:
    void keep_part_order() {
        std::vector<Corner> first(part_.positions.size(), Corner{no_vertex, 0, 0});
        for (const SurfaceFace& face : part_.faces)
            for (std::size_t k = 0; k < corner_count(face); ++k)
                if (first[face.corners[k]].vertex == no_vertex) first[face.corners[k]] = corner_of(face, k);
        for (const Corner& c : first) index(c);
    }

    std::uint16_t index(const Corner& corner) {
        const auto [entry, is_new] = number_.emplace(corner, static_cast<std::uint16_t>(result_.vertices.size()));
        if (is_new) result_.vertices.push_back(corner);
        return entry->second;
    }

    // Quads are cut along the shorter diagonal, the first one if they are equal.
    void add(const SurfaceFace& face) {
        std::array<std::uint16_t, 4> c{};
        for (std::size_t k = 0; k < corner_count(face); ++k) c[k] = index(corner_of(face, k));
        const auto at = [&](std::size_t k) { return part_.positions[face.corners[k]]; };
        auto& out = result_.indices;
        if (corner_count(face) == 3)
            out.insert(out.end(), {c[0], c[1], c[2]});
        else if (distance(at(0), at(2)) <= distance(at(1), at(3)) + 1e-6)
            out.insert(out.end(), {c[0], c[1], c[2], c[0], c[2], c[3]});
        else
            out.insert(out.end(), {c[0], c[1], c[3], c[1], c[2], c[3]});
    }

    const Surface& part_;
    Primitive result_;
    std::map<Corner, std::uint16_t> number_;
};

double rounded(double value, double steps) {
    return std::round(value * steps) / steps + 0.0;
}

struct Glb {
    std::string binary, views, accessors;
    int view_count = 0;

    template <class T>
    void put(T value) {
        char bytes[sizeof(T)];
        std::memcpy(bytes, &value, sizeof(T));
        binary.append(bytes, sizeof(T));
    }

    // Describes the bytes put since `start` as an accessor and returns its number.
    int close(std::size_t start, std::size_t count, int component, const char* type, int target,
              const std::string& more = {}) {
        const std::size_t bytes = binary.size() - start;
        while (binary.size() % 4 != 0) binary.push_back('\0');
        const char* comma = view_count == 0 ? "" : ",\n";
        fmt::format_to(std::back_inserter(views), R"({}{{"buffer":0,"byteOffset":{},"byteLength":{},"target":{}}})",
                       comma, start, bytes, target);
        fmt::format_to(std::back_inserter(accessors),
                       R"({}{{"bufferView":{},"componentType":{},"count":{},"type":"{}"{}}})", comma, view_count,
                       component, count, type, more);
        return view_count++;
    }
};

constexpr int byte_type = 5121, short_type = 5123, float_type = 5126, vertex_target = 34962, index_target = 34963;

int put_positions(Glb& glb, const Surface& part, const Primitive& p) {
    const std::size_t start = glb.binary.size();
    Vec3f low{1e9F, 1e9F, 1e9F}, high{-1e9F, -1e9F, -1e9F};
    for (const Corner& c : p.vertices) {
        const Vec3f v = to_float(part.positions[c.vertex] / 1000.0);
        for (const float t : {v.x, v.y, v.z}) glb.put(t);
        low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
        high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
    return glb.close(start, p.vertices.size(), float_type, "VEC3", vertex_target,
                     fmt::format(R"(,"min":[{},{},{}],"max":[{},{},{}])", low.x, low.y, low.z, high.x, high.y, high.z));
}

int put_normals(Glb& glb, const std::vector<Vec3>& normals, const Primitive& p) {
    const std::size_t start = glb.binary.size();
    for (const Corner& c : p.vertices)
        for (const double t : {normals[c.vertex].x, normals[c.vertex].y, normals[c.vertex].z})
            glb.put(static_cast<float>(rounded(t, 10000)));
    return glb.close(start, p.vertices.size(), float_type, "VEC3", vertex_target);
}

int put_uvs(Glb& glb, const Primitive& p) {
    const std::size_t start = glb.binary.size();
    for (const Corner& c : p.vertices)
        for (const std::int64_t t : {c.u, c.v}) glb.put(static_cast<float>(static_cast<double>(t) / 65536));
    return glb.close(start, p.vertices.size(), float_type, "VEC2", vertex_target);
}

int put_colours(Glb& glb, const Surface& part, const Primitive& p) {
    const std::size_t start = glb.binary.size();
    for (const Corner& c : p.vertices) {
        const Colour& colour = part.colours[c.vertex];
        for (const double t : {colour.r, colour.g, colour.b, colour.a})
            glb.put(static_cast<std::uint8_t>(std::lround(t * 255)));
    }
    return glb.close(start, p.vertices.size(), byte_type, "VEC4", vertex_target, R"(,"normalized":true)");
}

std::string put_primitive(Glb& glb, const Surface& part, const std::vector<Vec3>& normals, const Primitive& p,
                          std::size_t material) {
    // One after the other: the order in which a call evaluates its arguments differs between compilers.
    const int positions = put_positions(glb, part, p);
    const int normal = put_normals(glb, normals, p);
    const int uvs = put_uvs(glb, p);
    std::string text =
        fmt::format(R"({{"attributes":{{"POSITION":{},"NORMAL":{},"TEXCOORD_0":{})", positions, normal, uvs);
    if (!part.colours.empty()) text += fmt::format(R"(,"COLOR_0":{})", put_colours(glb, part, p));
    const std::size_t start = glb.binary.size();
    for (const auto i : p.indices) glb.put(i);
    const int indices = glb.close(start, p.indices.size(), short_type, "SCALAR", index_target);
    return text + fmt::format(R"(}},"indices":{},"material":{}}})", indices, material);
}

std::string material_text(const Material& m, const Head& head) {
    std::string picture;
    for (std::size_t i = 0; i < head.pictures.size(); ++i)
        if (head.pictures[i].name == m.picture) picture = fmt::format(R"("baseColorTexture":{{"index":{}}},)", i);
    return fmt::format(
        R"({{"name":"{}","pbrMetallicRoughness":{{{}"baseColorFactor":[{},{},{},{}],"metallicFactor":0,"roughnessFactor":{}}}{}{}}})",
        m.name, picture, m.colour.r, m.colour.g, m.colour.b, m.colour.a, m.roughness,
        m.colour.a < 1 ? R"(,"alphaMode":"BLEND")" : "", m.two_sided ? R"(,"doubleSided":true)" : "");
}

// A picture in the buffer as PNG; returns its view's number.
std::size_t put_picture(Glb& glb, const Picture& picture) {
    const std::size_t start = glb.binary.size();
    for (const std::byte b : format_png(picture)) glb.binary.push_back(static_cast<char>(b));
    const std::size_t bytes = glb.binary.size() - start;
    while (glb.binary.size() % 4 != 0) glb.binary.push_back('\0');
    fmt::format_to(std::back_inserter(glb.views),
                   ",\n"
                   R"({{"buffer":0,"byteOffset":{},"byteLength":{}}})",
                   start, bytes);
    return static_cast<std::size_t>(glb.view_count++);
}

std::string joined(const std::vector<std::string>& items) {
    return fmt::format("{}", fmt::join(items, ",\n"));
}

std::string container(std::string json, const std::string& binary) {
    while (json.size() % 4 != 0) json.push_back(' ');
    Glb out;
    for (const std::size_t word : {std::size_t{0x46546C67}, std::size_t{2}, 28 + json.size() + binary.size(),
                                   json.size(), std::size_t{0x4E4F534A}})
        out.put(static_cast<std::uint32_t>(word));
    out.binary += json;
    out.put(static_cast<std::uint32_t>(binary.size()));
    out.put(std::uint32_t{0x004E4942});
    return out.binary + binary;
}

}  // namespace

std::size_t vertex_in_glb(const Surface& part, std::uint32_t vertex) {
    std::size_t before = 0;
    for (std::uint32_t m = 0; m < part.materials.size(); ++m) {
        const Primitive primitive = PrimitiveMaker(part, m).result();
        const auto is_copy = [&](const Corner& c) { return c.vertex == vertex; };
        const auto found = std::find_if(primitive.vertices.begin(), primitive.vertices.end(), is_copy);
        if (found != primitive.vertices.end())
            return before + static_cast<std::size_t>(found - primitive.vertices.begin());
        before += primitive.vertices.size();
    }
    return before;
}

std::string format_glb(const Head& head) {
    Glb glb;
    std::vector<std::string> meshes, nodes, materials;
    std::vector<std::size_t> roots;
    std::map<std::string, std::size_t> material_number;
    for (const Surface& part : head.parts) {
        const std::vector<Vec3> normals = vertex_normals(part);
        std::vector<std::string> primitives;
        for (std::uint32_t m = 0; m < part.materials.size(); ++m) {
            const auto [entry, is_new] = material_number.emplace(part.materials[m].name, materials.size());
            if (is_new) materials.push_back(material_text(part.materials[m], head));
            primitives.push_back(put_primitive(glb, part, normals, PrimitiveMaker(part, m).result(), entry->second));
        }
        roots.push_back(nodes.size());
        nodes.push_back(fmt::format(R"({{"name":"{}","mesh":{}}})", part.name, nodes.size()));
        meshes.push_back(fmt::format(R"({{"name":"{}","primitives":[{}]}})", part.name, joined(primitives)));
    }
    std::vector<std::string> images, textures;
    for (const NamedPicture& p : head.pictures) {
        textures.push_back(fmt::format(R"({{"source":{}}})", images.size()));
        images.push_back(fmt::format(R"({{"name":"{}","mimeType":"image/png","bufferView":{}}})", p.name,
                                     put_picture(glb, p.picture)));
    }
    const std::string json = fmt::format(
        R"({{"asset":{{"version":"2.0","generator":"mien_samples"}},"scene":0,"scenes":[{{"name":"sample","nodes":[{}]}}],"nodes":[{}],"meshes":[{}],"materials":[{}],"textures":[{}],"images":[{}],"accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{}}}]}})",
        fmt::join(roots, ","), joined(nodes), joined(meshes), joined(materials), joined(textures), joined(images),
        glb.accessors, glb.views, glb.binary.size());
    return container(json, glb.binary);
}

}  // namespace mien::samples
