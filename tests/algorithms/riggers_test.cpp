// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/riggers.hpp"

#include <gmock/gmock.h>
#include <set>

#include "shapes.hpp"

#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/algorithms/rig_surface_distance.hpp"
#include "mien/error.hpp"

namespace mien {
namespace {

TEST(Riggers, AnUnknownMethodIsRefusedWithTheNamesOfAll) {
    for (const Rigger& rigger : riggers())
        EXPECT_THAT([] { make_rig(shapes::mask(), "magic"); },
                    testing::ThrowsMessage<Error>(
                        testing::AllOf(testing::HasSubstr("\"magic\""), testing::HasSubstr(std::string(rigger.name)))));
}

TEST(Riggers, HaveNamesOfTheirOwnAndASummary) {
    std::set<std::string_view> names;
    for (const Rigger& rigger : riggers()) {
        EXPECT_TRUE(names.insert(rigger.name).second) << rigger.name;
        EXPECT_FALSE(rigger.summary.empty());
    }
    EXPECT_TRUE(names.contains("surface-distance"));
}

TEST(Riggers, SignTheirRigs) {
    for (const Rigger& rigger : riggers()) EXPECT_EQ(make_rig(shapes::mask(), rigger.name).method, rigger.name);
}

TEST(Riggers, TheFirstIsTheDefault) {
    EXPECT_EQ(riggers().front().name, "biharmonic");
}

TEST(Riggers, PassTheNumberOfInfluencesOn) {
    RigOptions options;
    options.influences = 4;
    EXPECT_EQ(make_rig(shapes::mask(), "biharmonic", options).weights,
              rig_biharmonic(shapes::mask(), {.influences = 4}).weights);
}

TEST(Riggers, PassTheReadingOn) {
    const Face face = shapes::mask();
    for (const Reading reading : {Reading::paper, Reading::remedied}) {
        RigOptions options;
        options.reading = reading;
        EXPECT_EQ(make_rig(face, "surface-distance", options).weights, rig_surface_distance(face, {reading}).weights);
    }
}

}  // namespace
}  // namespace mien
