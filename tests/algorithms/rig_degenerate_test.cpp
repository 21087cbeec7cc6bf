// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Every rigger on heads that are broken or odd, beside the project: what can be rigged gives finite weights, and what
// cannot is refused with a sentence.

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <sstream>

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/riggers.hpp"
#include "mien/error.hpp"
#include "mien/io/points.hpp"
#include "mien/io/read.hpp"

namespace mien {
namespace {

namespace fs = std::filesystem;

class RigDegenerate : public testing::Test {
protected:
    void SetUp() override {
        if (!fs::exists(folder())) GTEST_SKIP() << "no " << folder();
        std::ifstream list(folder().parent_path() / "manifest.tsv");
        for (std::string line; std::getline(list, line);) {
            std::vector<std::string> cells;
            std::istringstream row(line);
            for (std::string cell; std::getline(row, cell, '\t');) cells.push_back(cell);
            if (cells.size() > 7 && cells[0].starts_with("degenerate/")) verdicts.emplace_back(cells[0], cells[7]);
        }
        ASSERT_GT(verdicts.size(), 40U);
    }
    static fs::path folder() { return fs::path(MIEN_SHARED) / "data" / "malformed" / "degenerate"; }

    static Face load(const std::string& head, const std::string& points = "degenerate/feature_points.json") {
        Face face{read_mesh(folder().parent_path() / head), {}};
        // A soup of triangles has other vertices than the base that the indices are for.
        const bool is_soup = head.find("soup") != head.npos;
        const Mesh base = is_soup ? read_mesh(folder() / "00_base.obj") : Mesh{};
        face.points = read_points(folder().parent_path() / points, is_soup ? base : face.mesh).points;
        for (FeaturePoint& point : face.points)
            if (is_soup) point.vertex = nearest(face.mesh, point.position);
        return face;
    }
    static std::uint32_t nearest(const Mesh& mesh, const Vec3& at) {
        std::uint32_t best = 0;
        for (std::uint32_t v = 0; v < vertex_count(mesh); ++v)
            if (distance(to_double(mesh.positions[v]), at) < distance(to_double(mesh.positions[best]), at)) best = v;
        return best;
    }
    // What the head does when its first point moves by a tenth of its size.
    static std::vector<Vec3f> posed(const Face& face, const std::string& method, const RigOptions& options) {
        const Rig rig = make_rig(face, method, options);
        std::vector<Vec3f> moves(rig.points.size()), out(vertex_count(rig));
        const double size = diagonal(bounding_box(face.mesh));
        moves.front().y = static_cast<float>(0.1 * size);
        for (const Vec3f& w : rig.weights) EXPECT_TRUE(is_finite(w)) << method;
        deform(rig, moves, out);
        for (const Vec3f& p : out) EXPECT_TRUE(is_finite(p)) << method;
        for (std::size_t v = 0; v < out.size(); ++v) out[v] -= rig.rest[v];
        return out;
    }
    template <class Check>
    static void with_every_rigger(Check check) {
        for (const Rigger& rigger : riggers())
            for (const Reading reading : {Reading::paper, Reading::remedied}) {
                RigOptions options;
                options.reading = reading;
                check(std::string(rigger.name), options);
            }
    }
    std::vector<std::pair<std::string, std::string>> verdicts;
};

TEST_F(RigDegenerate, WhatIsAcceptedIsRiggedAndWhatIsRejectedIsRefused) {
    for (const auto& [file, verdict] : verdicts) {
        const std::string extension = fs::path(file).extension().string();
        const bool is_points = file.find("/points/") != file.npos;
        if (extension == ".json" && !is_points) continue;
        if (!is_points && extension != ".obj" && extension != ".glb") continue;
        if (verdict == "either") continue;
        with_every_rigger([&, path = file, expected = verdict](const std::string& method, const RigOptions& options) {
            SCOPED_TRACE(fmt::format("{} with {}", path, method));
            const auto rig_it = [&] {
                posed(is_points ? load("degenerate/00_base.obj", path) : load(path), method, options);
            };
            if (expected == "accept")
                EXPECT_NO_THROW(rig_it());
            else
                EXPECT_THROW(rig_it(), Error);
        });
    }
}

TEST_F(RigDegenerate, UnitsAndPlacesFarAwayGiveTheMotionOfTheBase) {
    const Face base = load("degenerate/00_base.glb");
    with_every_rigger([&](const std::string& method, const RigOptions& options) {
        const std::vector<Vec3f> expected = posed(base, method, options);
        const double size = diagonal(bounding_box(base.mesh));
        for (const char* file : {"degenerate/11_scale_1e-6.glb", "degenerate/12_scale_1e6.glb"}) {
            const Face other = load(file);
            const double ratio = diagonal(bounding_box(other.mesh)) / size;
            const std::vector<Vec3f> found = posed(other, method, options);
            ASSERT_EQ(found.size(), expected.size());
            for (std::size_t v = 0; v < found.size(); ++v)
                ASSERT_LE(distance(to_double(found[v]) / ratio, to_double(expected[v])), 1e-4 * size)
                    << method << " " << file << " vertex " << v;
        }
    });
}

}  // namespace
}  // namespace mien
