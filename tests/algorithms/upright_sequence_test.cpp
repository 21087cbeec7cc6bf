// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/upright_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

#include "algorithms/rotation.hpp"
#include "animated_face.hpp"
#include "refusal.hpp"

#include "mien/error.hpp"

namespace mien {
namespace {

using testing::HasSubstr;

double angle_between(const Quaternion& a, const Quaternion& b) {
    const Quaternion off = conjugate(a) * b;
    return 2 * std::atan2(length(Vec3{off.x, off.y, off.z}), std::abs(off.w));
}

// An animation whose skull, back of the head and base of the nose keep still.
struct Moving {
    Face face = animated::head();
    FapStream stream = animated::all_at_once(60);
    std::vector<Pose> poses = animated::poses(60);
    MeshSequence sequence = animated::play(face, measure_fapu(face.points), stream, poses);
};

const FeaturePoint& point(const std::vector<FeaturePoint>& points, const char* id) {
    return points[*find_point(points, id)];
}

MeshSequence mapped(const MeshSequence& sequence, const std::function<Vec3(const Vec3&)>& map) {
    MeshSequence result = sequence;
    for (Vec3f& p : result.mesh.positions) p = to_float(map(to_double(p)));
    result.positions = [positions = sequence.positions, map](std::size_t row, std::span<Vec3f> filled) {
        positions(row, filled);
        for (Vec3f& p : filled) p = to_float(map(to_double(p)));
    };
    return result;
}

TEST(UprightSequence, TheMotionThatAHeadWasGivenIsTheMotionThatIsFound) {
    const Moving moving;
    const UprightSequence found = upright(moving.sequence, moving.face.points);
    EXPECT_EQ(found.source, Pose{}) << "a head that looks ahead stays as it is";
    for (std::size_t r = 0; r < moving.poses.size(); ++r) {
        EXPECT_LT(angle_between(found.head[r].rotation, moving.poses[r].rotation), 1e-5);
        EXPECT_LT(distance(apply(found.head[r], {0, 0, 0}), apply(moving.poses[r], {0, 0, 0})), 1e-3);
    }
    EXPECT_LT(found.skull_motion, 1e-6);
}

TEST(UprightSequence, ASkullIsFoundWithoutThePointsThatThePaperFixes) {
    Moving moving;
    std::erase_if(moving.face.points, [](const FeaturePoint& p) {
        return p.id == "7.1" || p.id == "11.4" || p.id == "9.15" || p.id == "11.1";
    });
    const UprightSequence found = upright(moving.sequence, moving.face.points);
    for (std::size_t r = 0; r < moving.poses.size(); ++r)
        EXPECT_LT(angle_between(found.head[r].rotation, moving.poses[r].rotation), 1e-5);
}

TEST(UprightSequence, SkinThatMovesIsNoSkull) {
    const Moving moving;
    const UprightSequence found = upright(moving.sequence, moving.face.points);
    std::vector<Vec3f> row(vertex_count(moving.face.mesh));
    const MeshSequence still = animated::play(moving.face, measure_fapu(moving.face.points), moving.stream);
    for (std::size_t r = 0; r < still.times.size(); r += 7) {
        still.positions(r, row);
        for (const std::uint32_t v : found.skull)
            EXPECT_LT(distance(row[v], moving.face.mesh.positions[v]), 0.01F) << "vertex " << v;
    }
}

TEST(UprightSequence, RowsComeBackToTheSourceByThePosesThatWereTakenOut) {
    const Moving moving;
    for (const Reading reading : {Reading::paper, Reading::remedied}) {
        const UprightSequence found = upright(moving.sequence, moving.face.points, reading);
        std::vector<Vec3f> source(vertex_count(moving.face.mesh)), still = source;
        for (const std::size_t r : {0U, 31U}) {
            moving.sequence.positions(r, source);
            found.sequence.positions(r, still);
            for (std::size_t v = 0; v < source.size(); v += 37)
                EXPECT_LT(
                    distance(apply(found.source, apply(found.head[r], to_double(still[v]))), to_double(source[v])),
                    1e-3);
        }
    }
}

TEST(UprightSequence, AsWrittenTheMiddleOfTheHeadIsTheMiddlePlaneAndTheLidsStandOverEachOther) {
    Moving moving;
    const Pose somewhere{animated::turn(Vec3{1, 2, 2} / 3.0, 0.8), {10, 20, 30}};
    const MeshSequence there = mapped(moving.sequence, [&](const Vec3& p) { return apply(somewhere, p); });
    const UprightSequence found = upright(there, moving.face.points, Reading::paper);
    for (const char* id : {"2.1", "11.4", "7.1"}) EXPECT_NEAR(point(found.points, id).position.x, 0, 1e-4) << id;
    const Vec3 left = point(found.points, "3.1").position - point(found.points, "3.3").position;
    const Vec3 right = point(found.points, "3.2").position - point(found.points, "3.4").position;
    EXPECT_NEAR(left.z + right.z, 0, 1e-4);
    EXPECT_GT(left.y, 0);
    EXPECT_GT(point(found.points, "3.7").position.x, 0) << "the subject's left";
}

TEST(UprightSequence, AsWrittenThreePointsTellTheHeadsMotion) {
    const Moving moving;
    const UprightSequence found = upright(moving.sequence, moving.face.points, Reading::paper);
    for (std::size_t r = 0; r < moving.poses.size(); ++r) {
        const Pose whole = found.source * found.head[r] * inverse(found.source);
        EXPECT_LT(angle_between(whole.rotation, moving.poses[r].rotation), 1e-5);
        EXPECT_LT(distance(apply(whole, {0, 0, 0}), apply(moving.poses[r], {0, 0, 0})), 1e-3);
    }
}

TEST(UprightSequence, AsWrittenMissingPointsAreNamed) {
    Moving moving;
    std::erase_if(moving.face.points, [](const FeaturePoint& p) { return p.id == "11.4"; });
    EXPECT_THAT(refusal([&] { upright(moving.sequence, moving.face.points, Reading::paper); }), HasSubstr("no 11.4"));
}

TEST(UprightSequence, PlaceSizeAndDirectionOfTheWholeAnimationChangeNoParameter) {
    const Moving moving;
    const Fapu units = measure_fapu(moving.face.points);
    const FapStream as_it_is = extract_faps(upright(moving.sequence, moving.face.points), units);
    const Quaternion turn = animated::turn({0, 1, 0}, 0.7) * animated::turn({0, 0, 1}, 0.3);
    const MeshSequence elsewhere = mapped(moving.sequence, [&](const Vec3& p) {
        return 3.0 * rotate(turn, p) + Vec3{500, -200, 100};
    });
    const UprightSequence found = upright(elsewhere, moving.face.points);
    Vec3 middle, middle_there;
    for (const FeaturePoint& p : found.points) {
        middle += p.position;
        middle_there += to_double(elsewhere.mesh.positions[p.vertex]);
    }
    EXPECT_LT(distance(middle, middle_there), 0.1) << "a head that is turned stays at its place";
    const FapStream again = extract_faps(found, measure_fapu(found.points));
    ASSERT_EQ(again.frames.size(), as_it_is.frames.size());
    for (std::size_t r = 0; r < again.frames.size(); ++r)
        for (int fap = 3; fap <= 68; ++fap)
            EXPECT_NEAR(again.frames[r].value[fap_index(fap)], as_it_is.frames[r].value[fap_index(fap)],
                        fap_info(fap).unit == FapUnit::angle ? 10 : 1)
                << fap_info(fap).name << " in row " << r;
}

TEST(UprightSequence, ASequenceIsShownAtAnotherRateByItsNearestRows) {
    MeshSequence sequence{shapes::grid(1, 1), {0, 0.1, 0.2, 0.3, 0.4}, {}};
    sequence.positions = [](std::size_t row, std::span<Vec3f> p) { p[0].x = static_cast<float>(row); };
    const MeshSequence halved = at_rate(sequence, 5);
    ASSERT_EQ(halved.times, (std::vector<double>{0, 0.2, 0.4}));
    std::vector<Vec3f> row(4);
    halved.positions(1, row);
    EXPECT_EQ(row[0].x, 2);
    at_rate(sequence, 3).positions(1, row);
    EXPECT_EQ(row[0].x, 3) << "0.3 is nearer to a third than 0.4";
    EXPECT_THAT(refusal([&] { at_rate(sequence, 0); }), HasSubstr("rate above 0"));
}

TEST(UprightSequence, AnAnimationWithoutRowsOrWithAPointOutsideTheMeshIsRefused) {
    const Face face = animated::head();
    EXPECT_THAT(refusal([&] { upright({face.mesh, {}, {}}, face.points); }), HasSubstr("found none"));
    std::vector<FeaturePoint> points = face.points;
    points.front().vertex = 1000000;
    EXPECT_THAT(refusal([&] { upright({face.mesh, {0}, {}}, points); }), HasSubstr("found 1000000"));
}

}  // namespace
}  // namespace mien
