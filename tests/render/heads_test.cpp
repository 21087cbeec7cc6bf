// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Whole heads through a whole take: where the device puts every vertex, against `deform`.

#include <array>
#include <filesystem>
#include <gtest/gtest.h>

#include "render/stage.hpp"

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/head.hpp"
#include "mien/algorithms/retarget.hpp"
#include "mien/algorithms/riggers.hpp"
#include "mien/io/read.hpp"
#include "mien/io/scene.hpp"

namespace mien {
namespace {

using std::filesystem::path;

struct Subject {
    const char* name;
    path head, points;
    std::uint32_t influences;
    bool constrained;
};

std::vector<Subject> subjects() {
    const path samples = path(MIEN_SOURCE) / "samples", shared = path(MIEN_SHARED) / "data";
    return {
        {"sample", samples / "head.glb", samples / "head.points.json", 12, false},
        {"constrained", samples / "head.glb", samples / "head.points.json", 12, true},
        {"ict", shared / "ict/ict_neutral.obj", shared / "ict/feature_points.json", 12, true},
        {"makehuman", shared / "mh-caucasian/mh-caucasian-male.obj", shared / "mh-caucasian/points-obj.json", 8, false},
    };
}

class Heads : public testing::TestWithParam<Subject> {
protected:
    void SetUp() override {
        std::string why;
        if (stage::renderer(&why) == nullptr) GTEST_SKIP() << why;
        if (!std::filesystem::exists(GetParam().head)) GTEST_SKIP() << "there is no " << GetParam().head;
    }
};

Face face_of(const Subject& subject) {
    Face face = read_face(subject.head, subject.points);
    for (std::size_t k = 0; subject.constrained && k < face.points.size(); k += 3) face.points[k].moves.z = false;
    for (std::size_t k = 1; subject.constrained && k < face.points.size(); k += 3) face.points[k].moves.x = false;
    return face;
}

Take take_for(const Face& face) {
    const path samples = path(MIEN_SOURCE) / "samples";
    const Take take =
        remove_head_motion(rename_points(read_take(samples / "take.trc"), read_marker_map(samples / "markers.csv")));
    return retarget(fit_retarget(take, face), take);
}

// The farthest vertex of any row, as a share of the head's height.
double farthest(const Rig& rig, const std::vector<std::uint32_t>& vertices, const Take& take, ModelId model) {
    const TakeBinding binding = bind_take(rig, take);
    std::vector<Vec3f> moves(rig.points.size()), expected(vertex_count(rig)), found(vertices.size());
    double far = 0, moved = 0;
    for (std::size_t r = 0; r < row_count(take); ++r) {
        displacements(rig, binding, row(take, r), moves);
        deform(rig, moves, expected);
        stage::renderer()->pose(model, moves);
        stage::renderer()->read_positions(model, found);
        for (std::size_t v = 0; v < found.size(); ++v) {
            far = std::max<double>(far, distance(found[v], expected[vertices[v]]));
            moved = std::max<double>(moved, distance(found[v], rig.rest[vertices[v]]));
        }
    }
    const Box box = stage::renderer()->rest_box(model);
    EXPECT_GT(moved, 0.02 * (box.high.y - box.low.y)) << "the take moves the head";
    return far / (box.high.y - box.low.y);
}

TEST_P(Heads, TheDevicePutsEveryVertexOfEveryRowWhereDeformDoes) {
    const Face face = face_of(GetParam());
    const Rig rig = make_rig(face, "biharmonic", {Reading::remedied, GetParam().influences});
    const Scene scene = scene_of(face.mesh);
    const ModelId model = stage::renderer()->upload(scene, {&rig, {}});
    std::vector<std::uint32_t> vertices;
    for (const Surface& surface : scene.surfaces)
        vertices.insert(vertices.end(), surface.mesh_vertices.begin(), surface.mesh_vertices.end());
    EXPECT_LT(farthest(rig, vertices, take_for(face), model), 1e-5);
    stage::renderer()->remove(model);
}

INSTANTIATE_TEST_SUITE_P(Real, Heads, testing::ValuesIn(subjects()),
                         [](const auto& subject) { return std::string(subject.param.name); });

}  // namespace
}  // namespace mien
