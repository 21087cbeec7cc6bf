// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The committed files of samples/: what the generator makes, byte for byte, and what mien's own readers find in them.

#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "performance.hpp"
#include "write_surfaces.hpp"

#include "mien/io/marker_map.hpp"
#include "mien/io/obj.hpp"
#include "mien/io/points.hpp"
#include "mien/io/trc.hpp"

namespace mien::samples {
namespace {

std::string committed(const std::string& name) {
    std::ifstream file(std::filesystem::path(MIEN_SOURCE) / "samples" / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::span<const std::byte> bytes(const std::string& text) {
    return std::as_bytes(std::span(text));
}

const Head& head() {
    static const Head made = make_head(cast().front());
    return made;
}

// Not EXPECT_EQ: half a megabyte of difference helps nobody.
void expect_same(const std::string& made, const std::string& name) {
    EXPECT_TRUE(made == committed(name)) << name << " differs from what mien_samples writes";
    EXPECT_GT(made.size(), 100U);
    EXPECT_LT(made.size(), 1'500'000U);
}

TEST(SampleFiles, AreWhatTheGeneratorMakes) {
    for (const Character& character : cast()) {
        const Head made = make_head(character);
        expect_same(format_glb(made), made.name + ".glb");
        expect_same(format_points_by_mesh(made), made.name + ".points.json");
    }
    expect_same(format_obj(head().parts), "head.obj");
    expect_same(format_points_by_vertex(head()), "head-obj.points.json");
    expect_same(format_trc_take(perform(head()).take), "take.trc");
    expect_same(format_names(perform(head())), "markers.csv");
}

TEST(SampleFiles, ObjAndItsPointsReadAsTheHead) {
    const std::string obj = committed("head.obj"), points = committed("head-obj.points.json");
    const Mesh mesh = parse_obj(bytes(obj));
    const PointsFile file = parse_points(bytes(points), mesh);
    std::size_t vertices = 0, faces = 0;
    for (const Surface& part : head().parts) vertices += part.positions.size(), faces += part.faces.size();
    EXPECT_EQ(vertex_count(mesh), vertices);
    EXPECT_EQ(face_count(mesh), faces);
    EXPECT_TRUE(file.warnings.empty());
    ASSERT_EQ(file.points.size(), head().points.size());
    for (const HeadPoint& p : head().points) {
        const auto found = find_point(file.points, p.id);
        ASSERT_TRUE(found.has_value()) << p.id;
        EXPECT_LT(distance(file.points[*found].position, place(head(), p) / 1000.0), 1e-6) << p.id;
    }
}

TEST(SampleFiles, TakeAndMarkersReadAsThePerformance) {
    const std::string trc = committed("take.trc"), names = committed("markers.csv");
    const Performance made = perform(head());
    const Take take = parse_trc(bytes(trc));
    ASSERT_EQ(take.points, made.take.points);
    ASSERT_EQ(take.samples.size(), made.take.samples.size());
    EXPECT_EQ(take.unit, "mm");
    for (std::size_t i = 0; i < take.samples.size(); ++i) {
        ASSERT_EQ(is_finite(take.samples[i]), is_finite(made.take.samples[i]));
        const double error = distance(take.samples[i], made.take.samples[i]);
        ASSERT_FALSE(error > 1e-3);
    }
    const std::vector<Rename> map = parse_marker_map(bytes(names));
    ASSERT_EQ(rename_points(take, map).points.size(), take.points.size());
}

// Positions of a mesh of the GLB over its primitives, in metres.
std::vector<Vec3f> glb_positions(const std::string& glb, const nlohmann::json& tree, const nlohmann::json& mesh) {
    std::uint32_t json_size = 0;
    std::memcpy(&json_size, glb.data() + 12, 4);
    std::vector<Vec3f> result;
    for (const auto& primitive : mesh.at("primitives")) {
        const auto& accessor = tree.at("accessors").at(primitive.at("attributes").at("POSITION").get<std::size_t>());
        const auto& view = tree.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
        const std::size_t start = 28 + json_size + view.at("byteOffset").get<std::size_t>();
        for (std::size_t i = 0; i < accessor.at("count").get<std::size_t>(); ++i) {
            Vec3f p;
            std::memcpy(&p, glb.data() + start + 12 * i, 12);
            result.push_back(p);
        }
    }
    return result;
}

TEST(SampleFiles, PointsOfTheGlbLieWhereTheHeadHasThem) {
    const std::string glb = committed("head.glb");
    std::uint32_t json_size = 0;
    std::memcpy(&json_size, glb.data() + 12, 4);
    const auto tree = nlohmann::json::parse(glb.substr(20, json_size));
    const auto points = nlohmann::json::parse(committed("head.points.json")).at("points");
    ASSERT_EQ(points.size(), head().points.size());
    for (std::size_t part = 0; part < head().parts.size(); ++part) {
        const auto& mesh = tree.at("meshes").at(part);
        const std::vector<Vec3f> positions = glb_positions(glb, tree, mesh);
        for (const HeadPoint& p : head().points) {
            if (p.part != part) continue;
            const auto& entry = points.at(p.id);
            EXPECT_EQ(entry.at("mesh"), mesh.at("name"));
            const Vec3 found = to_double(positions.at(entry.at("vertex").get<std::size_t>()));
            EXPECT_LT(distance(found, place(head(), p) / 1000.0), 1e-6) << p.id;
        }
    }
}

}  // namespace
}  // namespace mien::samples
