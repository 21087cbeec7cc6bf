// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Rigs from example shapes against animated heads: the ICT face model, 27 shapes, and a MakeHuman head of another
// topology, 34 units (docs/methods.md). bench/prior.cpp has the figures that take longer.

#include "prior_figures.hpp"

#include <gtest/gtest.h>

#include "mien/algorithms/carry_shapes.hpp"
#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/algorithms/rig_prior.hpp"

namespace mien {
namespace {

using figures::Subject;

class PriorFigures : public testing::Test {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(figures::folder()) || !std::filesystem::exists(figures::folder("mh-caucasian")))
            GTEST_SKIP() << "no heads beside the project";
        subject = figures::read_subject();
    }
    [[nodiscard]] const std::vector<MorphTarget>& shapes() const { return subject.face.mesh.morph_targets; }

    Subject subject;
};

TEST_F(PriorFigures, ShapesThatWereLeftOutAreNearerThanTheSheetBringsThem) {
    const Subject asked = figures::with_points_of(subject, "dutreve21");
    const auto learnt = figures::leave_one_out(asked, [&](const std::vector<MorphTarget>& kept) {
        return rig_prior(asked.face, {kept, {}});
    });
    EXPECT_LE(learnt.error, 0.48);
    EXPECT_LT(learnt.error, figures::singles(rig_biharmonic(asked.face), asked).error);
    EXPECT_LE(learnt.flipped, 0.001);
}

TEST_F(PriorFigures, ThirteenSuggestedPointsSaveATenth) {
    const auto error = [&](const char* set) {
        const Subject asked = figures::with_points_of(subject, set);
        return figures::leave_one_out(asked,
                                      [&](const std::vector<MorphTarget>& kept) {
                                          return rig_prior(asked.face, {kept, {}});
                                      })
            .error;
    };
    EXPECT_LE(error("suggested"), 0.9 * error("all_skin"));
}

TEST_F(PriorFigures, MixesOfKnownShapesComeBackWithAlmostNoFlips) {
    for (const auto& [set, limit] : {std::pair{"all_skin", 0.10}, {"vicon27", 0.19}, {"dutreve21", 0.26}}) {
        const Subject asked = figures::with_points_of(subject, set);
        const auto mixed = figures::mixes(rig_prior(asked.face, {shapes(), {}}), asked, 40);
        EXPECT_LE(mixed.error, limit) << set;
        EXPECT_LE(mixed.flipped, 0.0005) << set;
    }
}

TEST_F(PriorFigures, EightPointsAVertexDoAlmostAsWellAsAll) {
    const Subject asked = figures::with_points_of(subject, "all_skin");
    std::vector<MorphTarget> half;
    for (const MorphTarget& shape : shapes())
        if (shape.name.starts_with("mouth") || shape.name.starts_with("jaw")) half.push_back(shape);
    const auto error = [&](std::uint32_t influences) {
        return figures::singles(rig_prior(asked.face, {half, {}}, {.influences = influences}), asked).error;
    };
    EXPECT_LE(error(8), 1.03 * error(0));
}

TEST_F(PriorFigures, ShapesOfAnotherHeadAreBetterThanNone) {
    const Subject other = figures::read_pocket_subject();
    const std::vector<MorphTarget> units = carry_shapes(other.face, other.face.mesh.morph_targets, subject.face);
    for (const char* set : {"all_skin", "vicon27", "dutreve21", "suggested"}) {
        const Subject asked = figures::with_points_of(subject, set);
        EXPECT_LT(figures::singles(rig_prior(asked.face, {{}, units}), asked).error,
                  figures::singles(rig_biharmonic(asked.face), asked).error)
            << set;
    }
}

TEST_F(PriorFigures, AHeadWithPocketsLearnsFromOneWithoutWherePointsAreFew) {
    const Subject other = figures::read_pocket_subject();
    const std::vector<MorphTarget> carried = carry_shapes(subject.face, shapes(), other.face);
    for (const char* set : {"vicon27", "dutreve21"}) {
        const Subject asked = figures::with_points_of(other, set);
        const Rig learnt = rig_prior(asked.face, {{}, carried}), free = rig_biharmonic(asked.face);
        EXPECT_LT(figures::singles(learnt, asked).error, figures::singles(free, asked).error) << set;
        EXPECT_LT(figures::mixes(learnt, asked, 20).error, figures::mixes(free, asked, 20).error) << set;
    }
}

}  // namespace
}  // namespace mien
