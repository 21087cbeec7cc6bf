// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What the device does with vertices, against sums worked out here.

#include <array>
#include <cmath>
#include <gmock/gmock.h>

#include "render/stage.hpp"

#include "mien/algorithms/deform.hpp"

namespace mien {
namespace {

using stage::Numbers;
using stage::positions;

class Moving : public stage::Drawing {};

// A ball with its poles on the z axis, radius 1.
Mesh ball() {
    return shapes::ball({}, 1, 24, 32);
}

// A rig of `points` points in which each vertex follows `influences` of them with weights of any sign; along some axes
// some points do not count, as constrained ones.
Rig wild_rig(const std::vector<Vec3f>& rest, std::uint16_t points, std::uint16_t influences) {
    Numbers number;
    Rig rig;
    rig.rest = rest;
    for (std::uint16_t k = 0; k < points; ++k) rig.points.push_back({std::to_string(k), k, to_double(rest[k]), {}, 0});
    rig.row_starts = {0};
    for (std::size_t v = 0; v < rest.size(); ++v) {
        for (std::uint16_t i = 0; i < influences; ++i) {
            rig.row_points.push_back(static_cast<std::uint16_t>((v + i * std::size_t{3}) % points));
            Vec3f w = number.vec();
            if (v % 3 == 0) w = {w.x, w.x, w.x};
            if (v % 5 == 0) w.z = 0;
            rig.weights.push_back(w);
        }
        rig.row_starts.push_back(static_cast<std::uint32_t>(rig.row_points.size()));
    }
    return rig;
}

std::vector<Vec3f> expected(const Rig& rig, std::span<const Vec3f> moves) {
    std::vector<Vec3f> out;
    for (std::size_t v = 0; v < rig.rest.size(); ++v) {
        Vec3 p = to_double(rig.rest[v]);
        for (std::uint32_t e = rig.row_starts[v]; e < rig.row_starts[v + 1]; ++e) {
            const Vec3 w = to_double(rig.weights[e]), d = to_double(moves[rig.row_points[e]]);
            p += {w.x * d.x, w.y * d.y, w.z * d.z};
        }
        out.push_back(to_float(p));
    }
    return out;
}

TEST_F(Moving, VerticesFollowTwelveSignedConstrainedPoints) {
    const Mesh mesh = ball();
    const Rig rig = wild_rig(mesh.positions, 37, 12);
    const ModelId model = device().upload(stage::scene(mesh), {&rig, {}});
    Numbers number;
    for (int frame = 0; frame < 3; ++frame) {
        std::vector<Vec3f> moves;
        for (std::size_t k = 0; k < rig.points.size(); ++k) moves.push_back(0.2F * number.vec());
        device().pose(model, moves);
        EXPECT_LT(stage::farthest(positions(model), expected(rig, moves)), 1e-6);
    }
    device().remove(model);
}

TEST_F(Moving, AnEyeballTurnsAboutItsCentreWhenItsPupilMoves) {
    Mesh mesh = shapes::ball({3, 0, 0}, 1, 12, 16);
    const Vec3 pupil{3, 0, 1};
    mesh.positions.push_back(to_float(pupil));
    Rig rig;
    rig.rest = mesh.positions;
    rig.row_starts.assign(mesh.positions.size() + 1, 0);
    rig.points = {{"3.5", static_cast<std::uint32_t>(mesh.positions.size() - 1), pupil, {}, 0}};
    rig.eyeballs = {{"eye", {}, {3, 0, 0}, 0}};
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) rig.eyeballs[0].vertices.push_back(v);
    const ModelId model = device().upload(stage::scene(mesh), {&rig, {}});
    // From straight ahead to 30 degrees towards +x: every vertex turns by that about the y axis.
    const double s = 0.5, c = std::sqrt(0.75);
    device().pose(model, std::array{to_float(Vec3{3 + s, 0, c} - pupil)});
    std::vector<Vec3f> turned;
    for (const Vec3f& p : mesh.positions) {
        const Vec3 d = to_double(p) - Vec3{3, 0, 0};
        turned.push_back(to_float(Vec3{3 + c * d.x + s * d.z, d.y, -s * d.x + c * d.z}));
    }
    EXPECT_LT(stage::farthest(positions(model), turned), 2e-6);
    device().remove(model);
}

TEST_F(Moving, ShapesAndPointsAddUp) {
    const Mesh mesh = ball();
    const Rig rig = wild_rig(mesh.positions, 9, 4);
    Numbers number;
    std::vector<MorphTarget> shapes(2);
    std::vector<Vec3f> delta(mesh.positions.size());
    for (std::uint32_t v = 0; v < mesh.positions.size(); v += 2)
        for (std::size_t s = 0; s < 2; ++s) {
            shapes[s].vertices.push_back(v);
            shapes[s].deltas.push_back(number.vec());
            delta[v] += (s == 0 ? 0.5F : -1.25F) * shapes[s].deltas.back();
        }
    std::vector<Vec3f> moves(rig.points.size());
    for (Vec3f& move : moves) move = 0.3F * number.vec();
    const ModelId model = device().upload(stage::scene(mesh), {&rig, shapes});
    device().pose(model, moves, std::array{0.5F, -1.25F});
    std::vector<Vec3f> sum = expected(rig, moves);
    for (std::size_t v = 0; v < sum.size(); ++v) sum[v] += delta[v];
    EXPECT_LT(stage::farthest(positions(model), sum), 1e-6);
    device().remove(model);
}

TEST_F(Moving, APriorAddsItsShapesBesideThoseThatAreGiven) {
    const Mesh mesh = ball();
    Rig rig = wild_rig(mesh.positions, 9, 4);
    Numbers number;
    Prior prior;
    prior.shapes.resize(3);
    MorphTarget given;
    for (std::uint32_t v = 0; v < mesh.positions.size(); v += 3) {
        for (MorphTarget& shape : prior.shapes) {
            shape.vertices.push_back(v);
            shape.deltas.push_back(number.vec());
        }
        given.vertices.push_back(v);
        given.deltas.push_back(number.vec());
    }
    for (int i = 0; i < 3 * 9; ++i) prior.response.push_back(to_double(number.vec()));
    prior.stiffness = {2, 0.5, 0, 0.5, 3, -1, 0, -1, 2};
    rig.prior = prior;
    std::vector<Vec3f> moves(rig.points.size());
    for (Vec3f& move : moves) move = 0.2F * number.vec();
    const ModelId model = device().upload(stage::scene(mesh), {&rig, std::span(&given, 1)});
    device().pose(model, moves, std::array{0.75F});
    std::vector<Vec3f> sum(mesh.positions.size());
    deform(rig, moves, sum);
    EXPECT_GT(stage::farthest(sum, expected(rig, moves)), 0.01);
    for (std::size_t i = 0; i < given.vertices.size(); ++i) sum[given.vertices[i]] += 0.75F * given.deltas[i];
    EXPECT_LT(stage::farthest(positions(model), sum), 2e-6);
    device().pose(model, std::span<const Vec3f>());
    EXPECT_LT(stage::farthest(positions(model), mesh.positions), 1e-6);
    device().remove(model);
}

TEST_F(Moving, VerticesOfTheSceneFindTheirsInTheRig) {
    // One rig vertex stands for two of the scene, in another order.
    Rig rig;
    rig.rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    rig.points = {{"a", 0, {}, {}, 0}};
    rig.row_starts = {0, 1, 1, 1};
    rig.row_points = {0};
    rig.weights = {{1, 1, 1}};
    Scene scene;
    scene.nodes.emplace_back();
    scene.materials.emplace_back();
    scene.surfaces.emplace_back();
    scene.surfaces[0].positions.resize(4);
    scene.surfaces[0].triangles = {0, 1, 2, 0, 3, 2};
    scene.surfaces[0].mesh_vertices = {2, 0, 1, 0};
    const ModelId model = device().upload(scene, {&rig, {}});
    device().pose(model, std::array{Vec3f{0, 0, 5}});
    EXPECT_THAT(positions(model), testing::ElementsAre(Vec3f{0, 1, 0}, Vec3f{0, 0, 5}, Vec3f{1, 0, 0}, Vec3f{0, 0, 5}));
    device().remove(model);
}

// A ball on node 1, which is shifted and turned; two morph targets.
Scene morphing_ball() {
    Scene scene = stage::scene(ball());
    scene.nodes.emplace_back();
    scene.nodes[1].parent = 0;
    scene.nodes[1].translation = {0, 2, 0};
    scene.nodes[1].morph_weights = {0, 0};
    scene.surfaces[0].node = 1;
    Numbers number;
    scene.surfaces[0].morphs.resize(2);
    for (MorphTarget& morph : scene.surfaces[0].morphs)
        for (std::uint32_t v = 3; v < 200; v += 7) {
            morph.vertices.push_back(v);
            morph.deltas.push_back(number.vec());
        }
    return scene;
}

TEST_F(Moving, MorphTargetsMoveInTheSpaceOfTheirNode) {
    const Scene scene = morphing_ball();
    const ModelId model = device().upload(scene);
    ScenePose pose = rest_pose(scene);
    pose.worlds[1] = {{Vec3{0, 2, 0}, Vec3{-2, 0, 0}, Vec3{0, 0, 2}}, {5, 6, 7}};
    pose.morph_weights[1] = {-0.75F, 0.5F};
    device().pose(model, pose);
    std::vector<Vec3f> sum = scene.surfaces[0].positions;
    for (std::size_t m = 0; m < 2; ++m)
        for (std::size_t i = 0; i < scene.surfaces[0].morphs[m].vertices.size(); ++i)
            sum[scene.surfaces[0].morphs[m].vertices[i]] +=
                pose.morph_weights[1][m] * scene.surfaces[0].morphs[m].deltas[i];
    for (Vec3f& p : sum) p = to_float(moved(pose.worlds[1], to_double(p)));
    EXPECT_LT(stage::farthest(positions(model), sum), 3e-6);
    device().remove(model);
}

// A ball whose vertices hang on five of six joints each.
Scene skinned_ball() {
    Scene scene = stage::scene(ball());
    Surface& surface = scene.surfaces[0];
    surface.influences = 5;
    surface.skin = 0;
    scene.skins.emplace_back();
    for (std::uint32_t j = 0; j < 6; ++j) {
        scene.nodes.emplace_back();
        scene.skins[0].joints.push_back(j + 1);
        scene.skins[0].inverse_binds.push_back({{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, {0.1 * j, 0, 0}});
    }
    Numbers number;
    for (std::size_t v = 0; v < surface.positions.size(); ++v) {
        std::array<float, 5> w{};
        float sum = 0;
        for (float& x : w) sum += x = 1.01F + number();
        for (std::uint16_t i = 0; i < 5; ++i) {
            surface.joints.push_back(static_cast<std::uint16_t>((v + i) % 6));
            surface.weights.push_back(w[i] / sum);
        }
    }
    return scene;
}

TEST_F(Moving, JointsMoveVerticesByTheirWeights) {
    const Scene scene = skinned_ball();
    const ModelId model = device().upload(scene);
    ScenePose pose = rest_pose(scene);
    Numbers number;
    for (std::size_t j = 0; j < 6; ++j)
        for (Vec3& column : pose.worlds[j + 1].columns) column += 0.4 * to_double(number.vec());
    for (std::size_t j = 0; j < 6; ++j) pose.worlds[j + 1].offset = to_double(number.vec());
    device().pose(model, pose);
    std::vector<Vec3f> sum;
    const Surface& surface = scene.surfaces[0];
    for (std::size_t v = 0; v < surface.positions.size(); ++v) {
        Vec3 p;
        for (std::size_t i = 5 * v; i < 5 * v + 5; ++i) {
            const Vec3 bound = to_double(surface.positions[v]) + Vec3{0.1 * surface.joints[i], 0, 0};
            p += static_cast<double>(surface.weights[i]) * moved(pose.worlds[surface.joints[i] + 1U], bound);
        }
        sum.push_back(to_float(p));
    }
    EXPECT_LT(stage::farthest(positions(model), sum), 3e-6);
    device().remove(model);
}

// Normals of a ball after a linear map: its inverse transpose.
std::vector<Vec3f> mapped_normals(const std::vector<Vec3f>& normals, const Affine& map) {
    const auto& [a, b, c] = map.columns;
    std::vector<Vec3f> out;
    for (const Vec3f& n : normals) {
        const Vec3 m = n.x * cross(b, c) + n.y * cross(c, a) + n.z * cross(a, b);
        out.push_back(to_float(m / length(m)));
    }
    return out;
}

std::vector<Vec3f> outward(const Mesh& mesh) {
    std::vector<Vec3f> list;
    for (const Vec3f& p : mesh.positions) list.push_back(p / length(p));
    return list;
}

const Affine sheared{{Vec3{1.5, 0.2, 0}, Vec3{0.6, 0.8, -0.3}, Vec3{0, 0.4, 0.9}}, {}};

TEST_F(Moving, NormalsOfALinearMotionByPointsAreThoseOfTheInverseTranspose) {
    // Weights that are the coordinates themselves: position' = (1 + [a b c]) position.
    const Mesh mesh = ball();
    Scene scene = stage::scene(mesh);
    scene.surfaces[0].normals = outward(mesh);
    Rig rig;
    rig.rest = mesh.positions;
    rig.row_starts = {0};
    for (std::uint16_t k = 0; k < 3; ++k) rig.points.push_back({std::to_string(k), k, {1.0 * k, 0, 0}, {}, 0});
    for (const Vec3f& p : mesh.positions) {
        rig.row_points.insert(rig.row_points.end(), {0, 1, 2});
        rig.weights.insert(rig.weights.end(), {{p.x, p.x, p.x}, {p.y, p.y, p.y}, {p.z, p.z, p.z}});
        rig.row_starts.push_back(static_cast<std::uint32_t>(rig.row_points.size()));
    }
    const ModelId model = device().upload(scene, {&rig, {}});
    EXPECT_LT(stage::farthest(stage::normals(model), scene.surfaces[0].normals), 1e-6) << "at rest the file's";
    std::array<Vec3f, 3> moves;
    for (std::size_t k = 0; k < 3; ++k) moves[k] = to_float(sheared.columns[k] - Affine{}.columns[k]);
    device().pose(model, moves);
    EXPECT_LT(stage::farthest(stage::normals(model), mapped_normals(scene.surfaces[0].normals, sheared)), 1e-4);
    device().remove(model);
}

TEST_F(Moving, NormalsOfALinearMorphAreThoseOfTheInverseTranspose) {
    const Mesh mesh = ball();
    Scene scene = stage::scene(mesh);
    scene.surfaces[0].normals = outward(mesh);
    scene.surfaces[0].morphs.resize(1);
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        scene.surfaces[0].morphs[0].vertices.push_back(v);
        const Vec3 p = to_double(mesh.positions[v]);
        scene.surfaces[0].morphs[0].deltas.push_back(to_float(turned(sheared, p) - p));
    }
    const ModelId model = device().upload(scene);
    ScenePose pose = rest_pose(scene);
    pose.morph_weights[0] = {1};
    device().pose(model, pose);
    EXPECT_LT(stage::farthest(stage::normals(model), mapped_normals(scene.surfaces[0].normals, sheared)), 1e-4);
    device().remove(model);
}

TEST_F(Moving, NormalsBetweenTwoJointsTurnWithTheBlend) {
    // Two joints, of which the second shifts along y; its weight grows with x: together a shear, on a ball.
    const Mesh mesh = ball();
    Scene scene = stage::scene(mesh);
    Surface& surface = scene.surfaces[0];
    surface.normals = outward(mesh);
    surface.influences = 2;
    surface.skin = 0;
    scene.skins.emplace_back();
    for (const std::uint32_t j : {1U, 2U}) {
        scene.nodes.emplace_back();
        scene.skins[0].joints.push_back(j);
        scene.skins[0].inverse_binds.emplace_back();
    }
    for (const Vec3f& p : mesh.positions) {
        surface.joints.insert(surface.joints.end(), {0, 1});
        surface.weights.insert(surface.weights.end(), {0.5F - 0.5F * p.x, 0.5F + 0.5F * p.x});
    }
    const ModelId model = device().upload(scene);
    ScenePose pose = rest_pose(scene);
    pose.worlds[2].offset = {0, 0.8, 0};
    device().pose(model, pose);
    const Affine shear{{Vec3{1, 0.4, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, {}};
    EXPECT_LT(stage::farthest(stage::normals(model), mapped_normals(surface.normals, shear)), 1e-4);
    device().remove(model);
}

TEST_F(Moving, NormalsPointOutwardsUnderAMapThatMirrors) {
    const Mesh mesh = ball();
    Scene scene = stage::scene(mesh);
    scene.nodes[0].scale = {-1, 1, 1};
    for (const bool from_file : {true, false}) {
        if (from_file)
            scene.surfaces[0].normals = outward(mesh);
        else
            scene.surfaces[0].normals.clear();
        const ModelId model = device().upload(scene);
        std::vector<Vec3f> out = outward(mesh);
        for (Vec3f& n : out) n.x = -n.x;
        EXPECT_LT(stage::farthest(stage::normals(model), out), from_file ? 1e-5 : 0.1);
        device().remove(model);
    }
}

TEST_F(Moving, ATextureSeamDoesNotShow) {
    // A ball cut open along one meridian: both sides of the cut keep one normal while the ball is bent.
    Mesh mesh = ball();
    Scene scene = stage::scene(mesh);
    Surface& surface = scene.surfaces[0];
    const auto whole = static_cast<std::uint32_t>(surface.positions.size());
    std::vector<std::uint32_t> twin(whole, 0);
    for (std::uint32_t v = 0; v < whole; ++v)
        if (std::abs(mesh.positions[v].x) < 1e-6F) {
            twin[v] = static_cast<std::uint32_t>(surface.positions.size());
            surface.positions.push_back(mesh.positions[v]);
        }
    for (std::size_t i = 0; i < surface.triangles.size(); i += 3) {
        float x = 0;
        for (std::size_t c = 0; c < 3; ++c) x += surface.positions[surface.triangles[i + c]].x;
        for (std::size_t c = 0; c < 3 && x < 0; ++c)
            if (twin[surface.triangles[i + c]] != 0) surface.triangles[i + c] = twin[surface.triangles[i + c]];
    }
    surface.morphs.resize(1);
    for (std::uint32_t v = 0; v < surface.positions.size(); ++v) {
        surface.morphs[0].vertices.push_back(v);
        surface.morphs[0].deltas.push_back({0, surface.positions[v].x * surface.positions[v].x, 0});
    }
    const ModelId model = device().upload(scene);
    ScenePose pose = rest_pose(scene);
    pose.morph_weights[0] = {0.7F};
    device().pose(model, pose);
    const std::vector<Vec3f> normals = stage::normals(model);
    int twins = 0;
    for (std::uint32_t v = 0; v < whole; ++v)
        if (twin[v] != 0) {
            ++twins;
            EXPECT_LT(distance(normals[v], normals[twin[v]]), 1e-6F);
        }
    EXPECT_GT(twins, 20);
    device().remove(model);
}

TEST_F(Moving, LipsThatTouchAtRestKeepTheirOwnNormals) {
    // Two squares that share an edge in space but not in motion, at right angles: upwards and forwards.
    Scene scene;
    scene.nodes.emplace_back();
    scene.materials.emplace_back();
    scene.surfaces.emplace_back();
    Surface& surface = scene.surfaces[0];
    surface.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, -1}, {0, 0, -1}, {0, 0, 0}, {1, 0, 0}, {1, -1, 0}, {0, -1, 0}};
    surface.triangles = {0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6};
    surface.morphs = {{"open", {4, 5, 6, 7}, std::vector<Vec3f>(4, {0, -1, 0})}};
    const ModelId model = device().upload(scene);
    const std::vector<Vec3f> normals = stage::normals(model);
    for (std::size_t v = 0; v < 4; ++v) EXPECT_LT(distance(normals[v], {0, 1, 0}), 1e-6F);
    for (std::size_t v = 4; v < 8; ++v) EXPECT_LT(distance(normals[v], {0, 0, 1}), 1e-6F);
    device().remove(model);
}

TEST_F(Moving, AModelAndItsCopyHaveAPoseEach) {
    const Mesh mesh = ball();
    const Rig rig = wild_rig(mesh.positions, 9, 4);
    const ModelId model = device().upload(stage::scene(mesh), {&rig, {}});
    const ModelId copy = device().copy(model);
    const std::vector<Vec3f> moves(9, {0.1F, 0.2F, 0.3F});
    device().pose(copy, moves);
    EXPECT_EQ(positions(model), rig.rest);
    EXPECT_LT(stage::farthest(positions(copy), expected(rig, moves)), 1e-6);
    device().remove(model);
    EXPECT_LT(stage::farthest(positions(copy), expected(rig, moves)), 1e-6) << "a copy outlives its model";
    device().remove(copy);
}

TEST_F(Moving, AtRestEveryVertexIsWhereTheSceneHasIt) {
    Scene scene = morphing_ball();
    scene.nodes[1].morph_weights = {0.25F, 0};
    const ModelId model = device().upload(scene);
    std::vector<Vec3f> rest = scene.surfaces[0].positions;
    for (std::size_t i = 0; i < scene.surfaces[0].morphs[0].vertices.size(); ++i)
        rest[scene.surfaces[0].morphs[0].vertices[i]] += 0.25F * scene.surfaces[0].morphs[0].deltas[i];
    for (Vec3f& p : rest) p.y += 2;
    EXPECT_LT(stage::farthest(positions(model), rest), 1e-6);
    // The same scene with shapes from elsewhere rests there too.
    const std::vector<MorphTarget> shapes{{"none", {}, {}}};
    const ModelId other = device().upload(scene, {nullptr, shapes});
    EXPECT_LT(stage::farthest(positions(other), rest), 1e-6);
    for (const ModelId id : {model, other}) device().remove(id);
}

TEST_F(Moving, PosesOfTheWrongSizeAreRefused) {
    const Mesh mesh = ball();
    const Rig rig = wild_rig(mesh.positions, 9, 4);
    const Scene scene = stage::scene(mesh);
    const ModelId moved = device().upload(scene, {&rig, {}}), played = device().upload(scene);
    EXPECT_THROW(device().pose(moved, std::vector<Vec3f>(8)), Error);
    EXPECT_THROW(device().pose(moved, {}, std::array{1.0F}), Error);
    EXPECT_THROW(device().pose(moved, rest_pose(scene)), Error);
    EXPECT_THROW(device().pose(played, std::vector<Vec3f>(9)), Error);
    EXPECT_THROW(device().pose(played, ScenePose{}), Error);
    EXPECT_THROW(device().pose(played + 1000, rest_pose(scene)), Error);
    Rig short_rig = rig;
    short_rig.rest.pop_back();
    EXPECT_THROW(device().upload(scene, {&short_rig, {}}), Error);
    for (const ModelId id : {moved, played}) device().remove(id);
}

}  // namespace
}  // namespace mien
