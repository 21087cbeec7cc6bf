// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/suggest_points.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <map>
#include <set>

#include "shapes.hpp"

#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/error.hpp"

namespace mien {
namespace {

constexpr std::uint32_t columns = 48, rows = 72;
constexpr float step = 0.0625F;

// A face of ordinary proportions, eyes 1 apart, on a dome of 3 x 4.5 that falls back below the chin: brows, lids, nose
// and outer lips, but no chin, as Dutreve et al. count 21 points.
Face ordinary_face() {
    Face face{shapes::grid(columns, rows, step), {}};
    for (Vec3f& p : face.mesh.positions) {
        p -= {1.5F, 3.0F, 0};
        p.z = 0.55F - 0.45F * p.x * p.x - 0.12F * p.y * p.y;
        if (p.y < -1.75F) p.z -= 1.5F * (-1.75F - p.y);
    }
    const auto add = [&](const char* id, double x, double y) {
        const auto i = static_cast<std::uint32_t>(std::lround((x + 1.5) / double{step}));
        const auto j = static_cast<std::uint32_t>(std::lround((y + 3.0) / double{step}));
        face.points.push_back(shapes::point_at(face.mesh, id, j * (columns + 1) + i));
    };
    const auto pair = [&](const char* left, const char* right, double x, double y) {
        add(left, x, y);
        add(right, -x, y);
    };
    pair("4.1", "4.2", 0.25, 0.44), pair("4.3", "4.4", 0.56, 0.5), pair("4.5", "4.6", 0.81, 0.44);
    pair("3.1", "3.2", 0.5, 0.12), pair("3.3", "3.4", 0.5, -0.06), pair("9.1", "9.2", 0.31, -0.56);
    add("9.3", 0, -0.5), add("8.1", 0, -0.94), add("8.2", 0, -1.25), pair("8.3", "8.4", 0.44, -1.06);
    pair("8.5", "8.6", 0.19, -0.94), pair("8.7", "8.8", 0.19, -1.19);
    return face;
}

std::vector<std::string> names(const std::vector<Suggestion>& list) {
    std::vector<std::string> ids;
    ids.reserve(list.size());
    for (const Suggestion& s : list) ids.push_back(s.point.id);
    return ids;
}

TEST(SuggestPoints, TheChinComesFirstWhereAFaceHasNone) {
    const Face face = ordinary_face();
    const auto list = suggest_points(face);
    ASSERT_FALSE(list.empty());
    EXPECT_EQ(list[0].point.id, "2.10");
    EXPECT_EQ(list[0].place, "chin boss");
    EXPECT_NEAR(list[0].point.position.x, 0, 0.04);
    EXPECT_NEAR(list[0].point.position.y, -1.6, 0.15);
}

TEST(SuggestPoints, AreOnTheFaceAwayFromItsPointsAndFromEachOther) {
    Face face = ordinary_face();
    for (const Suggestion& s : suggest_points(face, {.count = 30})) {
        ASSERT_LT(s.point.vertex, vertex_count(face.mesh));
        EXPECT_EQ(s.point.position, to_double(face.mesh.positions[s.point.vertex]));
        for (const FeaturePoint& other : face.points) {
            EXPECT_NE(other.id, s.point.id);
            EXPECT_GT(distance(other.position, s.point.position), 0.07) << other.id << " " << s.point.id;
        }
        face.points.push_back(s.point);
    }
    EXPECT_GT(face.points.size(), 40U);
    EXPECT_NO_THROW(rig_biharmonic(face));
}

TEST(SuggestPoints, EachLessensWhatIsMissedAndTheNextGoesOnFromThere) {
    const auto list = suggest_points(ordinary_face(), {.count = 12});
    for (std::size_t i = 0; i < list.size(); ++i) {
        EXPECT_LT(list[i].error_after, list[i].error_before);
        EXPECT_GT(list[i].error_after, 0);
        EXPECT_LT(list[i].error_before, 1);
        const bool is_next = i > 0 && list[i].error_before != list[i - 1].error_before;
        EXPECT_TRUE(!is_next || list[i].error_before == list[i - 1].error_after);
    }
}

TEST(SuggestPoints, OfASymmetricFaceComeInMirroredPairs) {
    const auto list = suggest_points(ordinary_face(), {.count = 20});
    std::multiset<std::pair<double, double>> places;
    for (const Suggestion& s : list) places.insert({s.point.position.x, s.point.position.y});
    for (const auto& [x, y] : places) EXPECT_TRUE(places.contains({-x, y})) << x << " " << y;
}

TEST(SuggestPoints, OfNamedSitesLieOnTheirSide) {
    const auto list = suggest_points(ordinary_face(), {.count = 40});
    std::size_t pairs = 0;
    for (const Suggestion& s : list) {
        EXPECT_TRUE(!s.point.id.ends_with("-left") || s.point.position.x > 0.1) << s.point.id;
        EXPECT_TRUE(!s.point.id.ends_with("-right") || s.point.position.x < -0.1) << s.point.id;
        pairs += s.point.id.ends_with("-left") ? 1 : 0;
    }
    EXPECT_GT(pairs, 3U);
}

TEST(SuggestPoints, APointThatSitsInAnUnusualPlaceIsNotSuggestedAgain) {
    Face face = ordinary_face();
    face.points.push_back(shapes::point_at(face.mesh, "cheek-side-left", 10 * (columns + 1) + 24));
    for (const Suggestion& s : suggest_points(face, {.count = 40})) EXPECT_NE(s.point.id, "cheek-side-left");
}

TEST(SuggestPoints, AreAsManyAsAskedAtMost) {
    const Face face = ordinary_face();
    for (const std::uint32_t count : {0U, 1U, 2U, 6U}) EXPECT_LE(suggest_points(face, {.count = count}).size(), count);
    EXPECT_EQ(suggest_points(face, {.count = 1}).size(), 1U);
}

TEST(SuggestPoints, FewerAreTheBeginningOfMore) {
    const Face face = ordinary_face();
    const auto few = names(suggest_points(face, {.count = 3})), many = names(suggest_points(face, {.count = 9}));
    ASSERT_LE(few.size(), many.size());
    EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
}

TEST(SuggestPoints, WhatWasTakenIsNotSuggestedAgain) {
    Face face = ordinary_face();
    for (const Suggestion& s : suggest_points(face, {.count = 5})) face.points.push_back(s.point);
    const auto more = names(suggest_points(face, {.count = 5}));
    EXPECT_FALSE(more.empty());
    for (const std::string& id : more) EXPECT_FALSE(find_point(face.points, id)) << id;
}

TEST(SuggestPoints, SizeAndPlaceOfTheHeadDoNotMatter) {
    const Face face = ordinary_face();
    Face other = face;
    for (Vec3f& p : other.mesh.positions) p = 16.0F * p + Vec3f{8, -64, 4};
    for (FeaturePoint& p : other.points) p.position = to_double(other.mesh.positions[p.vertex]);
    const auto a = suggest_points(face), b = suggest_points(other);
    EXPECT_EQ(names(a), names(b));
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].point.vertex, b[i].point.vertex);
        EXPECT_NEAR(a[i].error_after, b[i].error_after, 1e-3);
    }
}

TEST(SuggestPoints, WhatTheHeadDoesNotHaveIsLeftOut) {
    Face mask = ordinary_face();  // its skin ends under the lower lip
    Mesh cut;
    cut.positions = mask.mesh.positions;
    for (std::size_t f = 0; f < face_count(mask.mesh); ++f)
        if (mask.mesh.positions[face(mask.mesh, f)[0]].y > -1.32F) add_face(cut, face(mask.mesh, f));
    mask.mesh = cut;
    for (const Suggestion& s : suggest_points(mask, {.count = 30})) {
        EXPECT_GT(s.point.position.y, -1.4) << s.point.id;
        EXPECT_LE(s.point.snapped, 0.36) << s.point.id;
    }
}

TEST(SuggestPoints, AFaceWithTooFewKnownPointsIsRefused) {
    Face face = ordinary_face();
    face.points.resize(3);
    EXPECT_THAT([&] { suggest_points(face); }, testing::ThrowsMessage<Error>(testing::HasSubstr("at least 4")));
    Face own = ordinary_face();
    for (FeaturePoint& point : own.points) point.id = "mine " + point.id;
    EXPECT_THROW(suggest_points(own), Error);
    EXPECT_THROW(suggest_points({ordinary_face().mesh, {}}), Error);
}

TEST(SuggestPoints, AUsersOwnPointsDoNotDisturb) {
    Face face = ordinary_face();
    face.points.push_back(shapes::point_at(face.mesh, "wart", 40 * (columns + 1) + 30));
    EXPECT_EQ(suggest_points(face)[0].point.id, "2.10");
}

}  // namespace
}  // namespace mien
