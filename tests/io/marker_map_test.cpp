// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/marker_map.hpp"

#include <gtest/gtest.h>

#include "io/hostile.hpp"

namespace mien {
namespace {

using testing::HasSubstr;

std::string refusal(std::string_view text) {
    return hostile::refusal(parse_marker_map, text);
}

TEST(MarkerMap, refuses_what_is_no_map) {
    EXPECT_THAT(refusal(""), HasSubstr("expected markers, found none"));
    EXPECT_THAT(refusal("chin,2.1\nchin,2.2\n"), HasSubstr("marker map line 2: expected each marker once"));
    EXPECT_THAT(refusal("chin\n"), HasSubstr("expected two cells"));
    EXPECT_THAT(refusal(",2.1\n"), HasSubstr("the name of a marker"));
    EXPECT_THAT(refusal("{\"markers\": {\"\": null}}"), HasSubstr("the name of a marker"));
    EXPECT_THAT(refusal("{}"), HasSubstr("/markers"));
    EXPECT_THAT(refusal("{\"markers\": {\"chin\": 2.1}}"),
                HasSubstr("/markers/chin: expected the id of a feature point in quotes"));
    EXPECT_THAT(refusal("{\"markers\": {\"chin\": \"2.1\", \"chin\": \"2.2\"}}"), HasSubstr("each key once"));
}

TEST(MarkerMap, csv_and_json_say_the_same) {
    for (const char* text :
         {"chin,2.1\r\n\"brow, left\",\r\n", R"({"about": "x", "markers": {"chin": "2.1", "brow, left": null}})"}) {
        const std::vector<Rename> names = parse_marker_map(hostile::Copy(text).bytes());
        ASSERT_EQ(names.size(), 2U);
        EXPECT_EQ(names[0].from + '>' + names[0].to, "chin>2.1");
        EXPECT_EQ(names[1].from + '>' + names[1].to, "brow, left>");
    }
}

TEST(MarkerMap, survives_every_prefix_and_every_changed_byte) {
    const auto promise = [](const std::vector<Rename>& names) { return !names.empty(); };
    hostile::sweep(parse_marker_map, "chin,2.1\r\n\"b\",\r\n", promise);
    hostile::sweep(parse_marker_map, R"({"markers": {"chin": "2.1", "b": null}})", promise);
}

}  // namespace
}  // namespace mien
