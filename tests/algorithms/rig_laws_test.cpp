// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What holds for every way to make a rig.

#include <algorithm>
#include <gmock/gmock.h>
#include <numeric>
#include <tbb/global_control.h>
#include <tuple>

#include "shapes.hpp"

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/riggers.hpp"
#include "mien/error.hpp"

namespace mien {
namespace {

class RigLaws : public testing::TestWithParam<std::tuple<std::string, Reading>> {
protected:
    static Rig rig(const Face& face) {
        const auto& [method, reading] = GetParam();
        RigOptions options;
        options.reading = reading;
        return make_rig(face, method, options);
    }
};

// Straight lines through space, and weights that sum to 1 at a point too: the third paper as written. What that does is
// held by EllipsoidPaper.*.
bool is_ellipsoid_as_written() {
    return RigLaws::GetParam() == std::tuple{"ellipsoid", Reading::paper};
}

// Distances through space cannot tell a lip from the one that it touches.
bool goes_through_space() {
    return is_ellipsoid_as_written() || std::get<0>(RigLaws::GetParam()) == "rbf";
}

std::vector<std::string> names() {
    std::vector<std::string> names;
    for (const Rigger& rigger : riggers()) names.emplace_back(rigger.name);
    return names;
}

std::string test_name(const testing::TestParamInfo<RigLaws::ParamType>& info) {
    std::string name = std::get<0>(info.param) + (std::get<1>(info.param) == Reading::paper ? "_paper" : "_remedied");
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(, RigLaws,
                         testing::Combine(testing::ValuesIn(names()),
                                          testing::Values(Reading::paper, Reading::remedied)),
                         test_name);

Vec3f weight(const Rig& rig, std::uint32_t vertex, std::size_t point) {
    for (std::uint32_t e = rig.row_starts[vertex]; e < rig.row_starts[vertex + 1]; ++e)
        if (rig.row_points[e] == point) return rig.weights[e];
    return {};
}

// Largest difference of any weight between a's vertex v and b's vertex vertex_in_b(v), points paired likewise.
template <class VertexInB, class PointInB>
double difference(const Rig& a, const Rig& b, VertexInB vertex_in_b, PointInB point_in_b) {
    double worst = 0;
    for (std::uint32_t v = 0; v < vertex_count(a); ++v)
        for (std::size_t i = 0; i < a.points.size(); ++i) {
            const Vec3f off = weight(a, v, i) - weight(b, vertex_in_b(v), point_in_b(i));
            worst = std::max({worst, std::abs(double{off.x}), std::abs(double{off.y}), std::abs(double{off.z})});
        }
    return worst;
}

constexpr auto same = [](auto index) { return index; };

// Two sheets that touch in space along their whole length; points at (2, 1) of each, and two more on each.
Face two_sheets() {
    Face face{shapes::grid(12, 6, 0.25F), {}};
    const auto lower = static_cast<std::uint32_t>(vertex_count(face.mesh));
    shapes::append(face.mesh, shapes::grid(12, 6, 0.25F), {0, 0, 1e-3F});
    for (const std::uint32_t v : {15U, 50U, 24U})
        for (const std::uint32_t first : {0U, lower})
            face.points.push_back(shapes::point_at(face.mesh, std::to_string(first + v), first + v));
    return face;
}

// A flat sheet of 24 x 14 quads with a closed slit along row 7: the row belongs to what is above it, what is below has
// a row of its own, 1e-3 behind, but for the corners. A point in the middle of each lip, at the corners, above and
// below.
Face closed_lips() {
    Face face{shapes::grid(24, 14, 0.125F), {}};
    const auto upper = [](std::uint32_t i) { return 7 * 25 + i; };
    std::vector<std::uint32_t> lower;
    for (std::uint32_t i = 7; i <= 17; ++i) {
        lower.push_back(static_cast<std::uint32_t>(vertex_count(face.mesh)));
        face.mesh.positions.push_back(face.mesh.positions[upper(i)] - Vec3f{0, 0, 1e-3F});
    }
    for (std::uint32_t f = 6 * 24; f < 7 * 24; ++f)
        for (std::uint32_t c = face.mesh.face_starts[f]; c < face.mesh.face_starts[f + 1]; ++c)
            if (std::uint32_t& v = face.mesh.face_vertices[c]; v >= upper(7) && v <= upper(17)) v = lower[v - upper(7)];
    const auto add = [&](const char* id, std::uint32_t v) {
        face.points.push_back(shapes::point_at(face.mesh, id, v));
    };
    add("2.2", upper(12)), add("2.3", lower[5]), add("8.3", upper(18)), add("8.4", upper(6));
    add("9.15", 10 * 25 + 12), add("2.10", 3 * 25 + 12);
    return face;
}

TEST_P(RigLaws, AHeadWithoutPointsIsRefused) {
    EXPECT_THROW(rig({shapes::mask().mesh, {}}), Error);
}

TEST_P(RigLaws, AHeadWithoutASurfaceIsRefused) {
    Face face = shapes::mask();
    face.mesh.face_starts = {0};
    face.mesh.face_vertices.clear();
    EXPECT_THROW(rig(face), Error);
    EXPECT_THROW(rig({}), Error);
    Face line = shapes::mask();
    for (Vec3f& p : line.mesh.positions) p = (p.x + 10 * p.y) * Vec3f{1, 2, 0};
    EXPECT_THAT([&] { rig(line); }, testing::ThrowsMessage<Error>(testing::HasSubstr("on one line")));
}

TEST_P(RigLaws, APointPastTheLastVertexIsRefusedByName) {
    Face face = shapes::mask();
    face.points[3].vertex = 625;
    EXPECT_THAT([&] { rig(face); }, testing::ThrowsMessage<Error>(testing::HasSubstr("point 2.4")));
}

TEST_P(RigLaws, TwoPointsOnOnePlaceOrOfOneNameAreRefused) {
    Face face = shapes::mask();
    face.points[3].vertex = face.points[2].vertex;
    EXPECT_THAT([&] { rig(face); }, testing::ThrowsMessage<Error>(testing::HasSubstr("2.10 and 2.4")));
    Face twice = shapes::mask();
    twice.points[3].id = "2.10";
    EXPECT_THROW(rig(twice), Error);
}

TEST_P(RigLaws, APositionThatIsNotFiniteIsRefused) {
    Face face = shapes::mask();
    face.mesh.positions[7].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(rig(face), Error);
}

TEST_P(RigLaws, ARigIsWellFormed) {
    const Face face = shapes::mask();
    const Rig made = rig(face);
    EXPECT_EQ(made.method, std::get<0>(GetParam()));
    EXPECT_EQ(made.rest, face.mesh.positions);
    ASSERT_EQ(made.row_starts.size(), 626U);
    EXPECT_EQ(made.row_starts.back(), made.row_points.size());
    EXPECT_EQ(made.weights.size(), made.row_points.size());
    for (std::size_t v = 0; v < 625; ++v)
        for (std::uint32_t e = made.row_starts[v]; e < made.row_starts[v + 1]; ++e) {
            EXPECT_LT(made.row_points[e], face.points.size());
            EXPECT_TRUE(is_finite(made.weights[e]));
            EXPECT_TRUE(e == made.row_starts[v] || made.row_points[e - 1] < made.row_points[e]);
        }
}

TEST_P(RigLaws, AVertexAtAPointFollowsItAlone) {
    const Face face = shapes::mask();
    const Rig made = rig(face);
    if (is_ellipsoid_as_written()) {
        EXPECT_LT(weight(made, face.points[0].vertex, 0).x, 1);
        return;
    }
    for (std::size_t i = 0; i < face.points.size(); ++i)
        for (std::size_t k = 0; k < face.points.size(); ++k)
            EXPECT_EQ(weight(made, face.points[i].vertex, k), (i == k ? Vec3f{1, 1, 1} : Vec3f{}));
}

TEST_P(RigLaws, SomethingMovesBesidesThePoints) {
    const Face face = shapes::mask();
    const Rig made = rig(face);
    const std::uint32_t beside_chin = face.points[2].vertex + 1;
    EXPECT_GT(weight(made, beside_chin, 2).y, 0.3F);
}

// The mask with points of eyes and brows alone: from them its lower edge is farther than skin follows.
Face masked_eyes() {
    Face face = shapes::mask();
    std::erase_if(face.points, [](const FeaturePoint& p) { return p.id.starts_with("2.") || p.id.starts_with("5."); });
    return face;
}

TEST_P(RigLaws, AMirroredVertexFollowsTheMirroredPoints) {
    for (const Face& face : {shapes::mask(), masked_eyes()}) {
        const auto mirrored_point = [&](std::size_t i) {
            const Vec3 p = face.points[i].position;
            const auto other = std::find_if(face.points.begin(), face.points.end(), [&](const FeaturePoint& q) {
                return q.position == Vec3{-p.x, p.y, p.z};
            });
            return static_cast<std::size_t>(other - face.points.begin());
        };
        const Rig made = rig(face);
        const auto mirrored_vertex = [](std::uint32_t v) { return v / 25 * 25 + 24 - v % 25; };
        EXPECT_LT(difference(made, made, mirrored_vertex, mirrored_point), 1e-5) << face.points.size();
    }
}

TEST_P(RigLaws, SizeAndPlaceOfTheHeadDoNotMatter) {
    const Face face = shapes::mask();
    Face other = face;
    for (Vec3f& p : other.mesh.positions) p = 64.0F * p + Vec3f{16, -128, 32};
    for (FeaturePoint& p : other.points) p.position = to_double(other.mesh.positions[p.vertex]);
    EXPECT_LT(difference(rig(face), rig(other), same, same), 1e-4);
}

// The same head with its vertices numbered otherwise, its faces backwards, and each from another corner.
template <class MovedTo>
Face in_another_order(const Face& face, MovedTo moved_to) {
    Face other = face;
    for (std::uint32_t v = 0; v < 625; ++v) other.mesh.positions[moved_to(v)] = face.mesh.positions[v];
    other.mesh.face_starts = {0};
    other.mesh.face_vertices.clear();
    for (std::size_t f = face_count(face.mesh); f-- > 0;) {
        std::vector<std::uint32_t> corners;
        for (const std::uint32_t v : mien::face(face.mesh, f)) corners.push_back(moved_to(v));
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
        add_face(other.mesh, corners);
    }
    for (FeaturePoint& p : other.points) p.vertex = moved_to(p.vertex);
    return other;
}

TEST_P(RigLaws, TheOrderOfVerticesAndFacesDoesNotMatter) {
    const auto moved_to = [](std::uint32_t v) { return (v * 7 + 3) % 625; };
    for (const Face& face : {shapes::mask(), masked_eyes()})
        EXPECT_LT(difference(rig(face), rig(in_another_order(face, moved_to)), moved_to, same), 1e-5)
            << face.points.size();
}

TEST_P(RigLaws, TheOrderOfPointsDoesNotMatter) {
    // Regions that grow by steps along edges, as written, meet at places that two points reach in the same step.
    const bool order_decides = GetParam() == std::tuple{"surface-distance", Reading::paper};
    for (const Face& face : {shapes::mask(), masked_eyes()}) {
        Face other = face;
        std::reverse(other.points.begin(), other.points.end());
        const auto reversed = [&](std::size_t i) { return face.points.size() - 1 - i; };
        const double off = difference(rig(face), rig(other), same, reversed);
        EXPECT_TRUE(order_decides || off < 1e-5) << face.points.size() << ": " << off;
    }
}

TEST_P(RigLaws, SplitVerticesMoveTogether) {
    // Every quad keeps its own four vertices, as a file with hard edges has them.
    const Face face = shapes::mask();
    Face split{{}, face.points};
    for (std::size_t f = 0; f < face_count(face.mesh); ++f) {
        const auto first = static_cast<std::uint32_t>(vertex_count(split.mesh));
        for (const std::uint32_t v : mien::face(face.mesh, f)) split.mesh.positions.push_back(face.mesh.positions[v]);
        add_face(split.mesh, std::array{first, first + 1, first + 2, first + 3});
    }
    std::vector<std::uint32_t> joined(vertex_count(split.mesh));
    for (std::size_t v = 0; v < joined.size(); ++v) joined[v] = face.mesh.face_vertices[v];
    for (FeaturePoint& p : split.points)
        p.vertex = static_cast<std::uint32_t>(std::find(joined.begin(), joined.end(), p.vertex) - joined.begin());
    EXPECT_LT(difference(
                  rig(split), rig(face), [&](std::uint32_t v) { return joined[v]; }, same),
              1e-5);
}

TEST_P(RigLaws, SheetsThatTouchOnlyInSpaceDoNotFollowEachOther) {
    const Face face = two_sheets();
    const Rig made = rig(face);
    if (is_ellipsoid_as_written()) {
        EXPECT_GT(weight(made, face.points[1].vertex, 0).x, 0);
        return;
    }
    for (std::uint32_t v = 0; v < vertex_count(face.mesh); ++v)
        for (std::size_t i = 0; i < face.points.size(); ++i)
            EXPECT_TRUE((v < 91) == (face.points[i].vertex < 91) || weight(made, v, i) == Vec3f{}) << v << " " << i;
    EXPECT_GT(weight(made, 16, 0).x, 0);
    EXPECT_GT(weight(made, 91 + 16, 1).x, 0);
}

TEST_P(RigLaws, LipsThatTouchDoNotFollowEachOther) {
    const Face face = closed_lips();
    const Rig made = rig(face);
    // Beside the points, on the lips.
    const std::uint32_t upper = 7 * 25 + 13, lower = face.points[1].vertex + 1;
    const double own = weight(made, upper, 0).x, others = weight(made, upper, 1).x;
    if (goes_through_space()) {
        EXPECT_NEAR(own, others, 0.01);
        return;
    }
    EXPECT_GT(own, 0.4);
    EXPECT_LT(std::abs(others), 0.1);
    EXPECT_GT(weight(made, lower, 1).x, 0.4F);
    EXPECT_LT(std::abs(weight(made, lower, 0).x), 0.1F);
}

TEST_P(RigLaws, APointHasNoWeightsAlongAnAxisItIsHeldIn) {
    Face face = shapes::mask();
    face.points[0].moves = {true, false, true};
    const Rig made = rig(face);
    for (std::uint32_t v = 0; v < 625; ++v) EXPECT_EQ(weight(made, v, 0).y, 0);
    const std::uint32_t at = face.points[0].vertex;
    if (!is_ellipsoid_as_written()) {
        EXPECT_EQ(weight(made, at, 0), (Vec3f{1, 0, 1}));
    }
    float others = 0;
    for (std::size_t i = 0; i < face.points.size(); ++i) others += std::abs(weight(made, at, i).y);
    EXPECT_GT(others, 0.01F);
}

TEST_P(RigLaws, TheNumberOfThreadsDoesNotMatter) {
    const auto with_threads = [&](std::size_t threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        return rig(shapes::mask());
    };
    const Rig one = with_threads(1);
    for (const std::size_t threads : {2U, 8U}) {
        const Rig many = with_threads(threads);
        EXPECT_EQ(many.row_starts, one.row_starts);
        EXPECT_EQ(many.row_points, one.row_points);
        EXPECT_EQ(many.weights, one.weights);
    }
}

TEST_P(RigLaws, PiecesWithoutPointsAreReportedAndComeThrough) {
    Face face = shapes::mask();
    shapes::append(face.mesh, shapes::ball({0, 3, -1}, 0.5F));
    const Rig made = rig(face);
    ASSERT_EQ(made.attachments.size(), 1U);
    EXPECT_EQ(made.attachments[0].how, "follows the skull");
    EXPECT_EQ(made.attachments[0].vertices, vertex_count(face.mesh) - 625);
    EXPECT_EQ(made.unreached, rig(shapes::mask()).unreached);
}

TEST_P(RigLaws, AHeadWithASinglePointHasARig) {
    Face face = shapes::mask();
    face.points.resize(1);
    const Rig made = rig(face);
    EXPECT_EQ(weight(made, face.points[0].vertex, 0), (Vec3f{1, 1, 1}));
}

}  // namespace
}  // namespace mien
