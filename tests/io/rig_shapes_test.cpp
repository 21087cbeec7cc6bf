// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What a rig knows from example shapes, in files: the exact block, and the morph targets that any engine plays.

#include <cstring>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "io/glb.hpp"
#include "io/gltf_player.hpp"
#include "io/promise.hpp"
#include "refusal.hpp"
#include "shapes.hpp"

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/rig_prior.hpp"
#include "mien/algorithms/skin.hpp"
#include "mien/error.hpp"
#include "mien/io/gltf.hpp"

namespace mien {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::byte>;

MorphTarget bump(const Mesh& mesh, const std::string& name, Vec3f centre, Vec3f motion) {
    MorphTarget shape{name, {}, {}};
    for (std::uint32_t v = 0; v < vertex_count(mesh); ++v) {
        const float d = length(mesh.positions[v] - centre);
        if (d > 1) continue;
        shape.vertices.push_back(v);
        shape.deltas.push_back(std::exp(-6 * d * d) * motion);
    }
    return shape;
}

// A mask with an eyeball, from an OBJ, and two shapes.
struct Head {
    Face face = shapes::mask();
    Rig rig;
    Skin skin;
    Head() {
        shapes::append(face.mesh, shapes::ball({0.5F, 0, -0.3F}, 0.2F));
        const std::vector<MorphTarget> own{bump(face.mesh, "smile", {0.4F, -0.8F, 0}, {0.1F, 0.12F, 0}),
                                           bump(face.mesh, "jaw", {0, -1.4F, 0}, {0, -0.3F, -0.05F})};
        rig = rig_prior(face, {own, {}});
        skin = make_skin(rig, {});
    }
    [[nodiscard]] Bytes file() const { return format_rig(face.mesh, rig, skin); }
};

void expect_same(const Prior& a, const Prior& b) {
    EXPECT_EQ(a.response, b.response);
    EXPECT_EQ(a.stiffness, b.stiffness);
    ASSERT_EQ(a.shapes.size(), b.shapes.size());
    for (std::size_t k = 0; k < a.shapes.size(); ++k) {
        EXPECT_EQ(a.shapes[k].name, b.shapes[k].name);
        EXPECT_EQ(a.shapes[k].vertices, b.shapes[k].vertices);
        EXPECT_EQ(a.shapes[k].deltas, b.shapes[k].deltas);
    }
}

TEST(RigShapes, APriorComesBackFromItsFileNumberForNumber) {
    const Head head;
    const RigFile read = parse_rig(head.file());
    ASSERT_TRUE(read.rig.prior);
    expect_same(*read.rig.prior, *head.rig.prior);
    EXPECT_EQ(format_rig(read.mesh, read.rig, head.skin), head.file());
}

TEST(RigShapes, ALinearPriorComesBackLinear) {
    Head head;
    head.rig.prior->stiffness.clear();
    EXPECT_FALSE(is_one_sided(*parse_rig(head.file()).rig.prior));
}

TEST(RigShapes, AHeadThatWasGltfIsNeutralAgainWithoutTargets) {
    const Head head;
    const auto none = [](std::string_view) { return Bytes(); };
    Head from_gltf;
    from_gltf.face.mesh = parse_gltf(format_glb(head.face.mesh, MorphTrack{}), none);
    ASSERT_EQ(from_gltf.face.mesh.positions.size(), head.rig.rest.size());
    from_gltf.rig.rest = from_gltf.face.mesh.positions;
    const Bytes file = from_gltf.file();
    const RigFile read = parse_rig(file);
    EXPECT_TRUE(read.mesh.morph_targets.empty());
    EXPECT_EQ(read.mesh.positions, from_gltf.face.mesh.positions);
    EXPECT_EQ(format_rig(read.mesh, read.rig, from_gltf.skin), file);
    EXPECT_EQ(parse_gltf(file, none).morph_targets.size(), 2U);
}

TEST(RigShapes, AShapeThatIsNotOfTheHeadIsNotWritten) {
    Head head;
    head.rig.prior->shapes[1].vertices.back() = 1'000'000;
    EXPECT_THAT([&] { return head.file(); },
                testing::ThrowsMessage<Error>(testing::HasSubstr("morph \"jaw\": expected")));
    EXPECT_THROW(format_glb(head.face.mesh, head.rig, head.skin, {}), Error);
}

// Every vertex moved by the skin's joints and the file's targets is where the joints would bring it, plus the shapes.
TEST(RigShapes, AnyPlayerAddsTheShapesThatDeformAdds) {
    const Head head;
    Take take;
    for (const FeaturePoint& point : head.face.points) take.points.push_back(point.id);
    for (int r = 0; r < 3; ++r) {
        take.times.push_back(0.5 * r);
        for (std::size_t i = 0; i < head.face.points.size(); ++i)
            take.samples.push_back(head.face.points[i].position +
                                   0.1 * r * Vec3{std::sin(1.0 * static_cast<double>(i)), i == 2 ? -2.0 : 0.5, 0.1});
    }
    Rig without = head.rig;
    without.prior.reset();
    const played::Player with_shapes(format_glb(head.face.mesh, head.rig, head.skin, take));
    const played::Player plain(format_glb(head.face.mesh, without, head.skin, take));
    const MeshSequence exact = deform(head.rig, head.face.mesh, take), rows = deform(without, head.face.mesh, take);
    double largest = 0;
    for (std::size_t r = 0; r < 3; ++r) {
        const std::vector<Vec3> a = with_shapes.positions(take.times[r]), b = plain.positions(take.times[r]);
        std::vector<Vec3f> c(vertex_count(head.rig)), d(vertex_count(head.rig));
        exact.positions(r, c);
        rows.positions(r, d);
        ASSERT_EQ(a.size(), c.size());
        for (std::size_t v = 0; v < a.size(); ++v) {
            EXPECT_LT(distance(a[v] - b[v], to_double(c[v] - d[v])), 3e-6) << r << " " << v;
            largest = std::max(largest, length(a[v] - b[v]));
        }
    }
    EXPECT_GT(largest, 0.01);
}

// What parse_rig says of the file after `change`; empty when it takes it.
std::string refusal(const std::function<void(GltfDocument&, json& prior)>& change) {
    static const Bytes file = Head().file();
    GltfDocument document = parse_glb(file);
    change(document, document.json["extensions"]["MIEN_rig"]["prior"]);
    return mien::refusal([&] { parse_rig(format_glb(document)); });
}

// The same with one number of an array changed.
template <class T>
std::string refusal_of_number(const std::function<json&(json&)>& array, std::size_t index, T value) {
    return refusal([&](GltfDocument& document, json& prior) {
        const json& view = document.json["bufferViews"][array(prior)["bufferView"].get<std::size_t>()];
        std::memcpy(document.binary.data() + view["byteOffset"].get<std::size_t>() + index * sizeof(T), &value,
                    sizeof value);
    });
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

#define EXPECT_SAYS(sentence, part) EXPECT_THAT(sentence, testing::HasSubstr(part))

TEST(RigShapes, MembersOfAnotherKindOrMissingAreRefused) {
    for (const char* name : {"shapes", "response", "stiffness"})
        for (const json& wrong : {json(nullptr), json(-1), json(true)})
            EXPECT_SAYS(refusal([&](GltfDocument&, json& p) { p[name] = wrong; }), std::string("prior/") + name);
    EXPECT_SAYS(refusal([](GltfDocument&, json& p) { p.erase("response"); }), "prior/response: expected");
    EXPECT_SAYS(refusal([](GltfDocument&, json& p) { p = 3; }), "/MIEN_rig/prior");
    EXPECT_SAYS(refusal([](GltfDocument&, json& p) { p["shapes"].erase(0); }), "prior/response/count: expected 14");
}

TEST(RigShapes, CountsThatDoNotFitAreRefused) {
    EXPECT_SAYS(refusal([](GltfDocument&, json& p) { p["response"] = {{"count", 0}}; }), "prior/response/count");
    EXPECT_SAYS(refusal([](GltfDocument&, json& p) { p["stiffness"] = p["response"]; }), "prior/stiffness/count");
    EXPECT_SAYS(refusal([](GltfDocument&, json& p) { p["shapes"][0]["deltas"] = p["shapes"][1]["deltas"]; }),
                "shapes/0/deltas/count");
    EXPECT_EQ(refusal([](GltfDocument&, json& p) { p["stiffness"] = {{"count", 0}}; }), "");
}

TEST(RigShapes, MoreShapesThanCanBeAreRefused) {
    EXPECT_SAYS(refusal([](GltfDocument&, json& p) {
                    while (p["shapes"].size() < 257) p["shapes"].push_back({{"name", ""}});
                }),
                "at most 256 shapes");
}

TEST(RigShapes, ManyShapesThatNameOneViewAreRefused) {
    EXPECT_SAYS(refusal([](GltfDocument&, json& p) {
                    while (p["shapes"].size() < 256) p["shapes"].push_back(p["shapes"][0]);
                }),
                "numbers of its own");
}

TEST(RigShapes, VerticesOutOfRangeInDisorderOrOfAnEyeballAreRefused) {
    const auto vertices = [](json& p) -> json& { return p["shapes"][1]["vertices"]; };
    const std::size_t last = Head().rig.prior->shapes[1].vertices.size() - 1;
    EXPECT_SAYS(refusal_of_number<std::uint32_t>(vertices, last, 4'000'000'000U), "expected vertices below");
    EXPECT_SAYS(refusal_of_number<std::uint32_t>(vertices, 1, 0), "vertices that rise");
    ASSERT_EQ(Head().rig.eyeballs.size(), 1U);
    EXPECT_SAYS(refusal_of_number<std::uint32_t>(vertices, last, 700), "vertices of no eyeball");
}

TEST(RigShapes, NumbersThatAreNoneAndMatricesThatAreNoStiffnessAreRefused) {
    const auto deltas = [](json& p) -> json& { return p["shapes"][0]["deltas"]; };
    const auto response = [](json& p) -> json& { return p["response"]; };
    const auto stiffness = [](json& p) -> json& { return p["stiffness"]; };
    EXPECT_SAYS(refusal_of_number(deltas, 4, std::numeric_limits<float>::infinity()), "finite numbers");
    EXPECT_SAYS(refusal_of_number(response, 4, not_a_number), "prior/response: expected finite numbers");
    EXPECT_SAYS(refusal_of_number(stiffness, 0, not_a_number), "symmetric matrix");
    EXPECT_SAYS(refusal_of_number(stiffness, 1, 1e9), "symmetric matrix");
    EXPECT_SAYS(refusal_of_number(stiffness, 0, -1.0), "positive definite");
    EXPECT_SAYS(refusal_of_number(stiffness, 3, 1e-300), "positive definite");
}

}  // namespace
}  // namespace mien
