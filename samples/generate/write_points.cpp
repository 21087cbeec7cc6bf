// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <fmt/format.h>
#include <iterator>

#include "write_surfaces.hpp"

namespace mien::samples {
namespace {

constexpr const char preface[] =
    "{{\n"
    "  \"_about\": \"MPEG-4 feature points of {}, {}; left and right are the subject's, the left is "
    "+x\",\n"
    "  \"_absent\": [\"11.5 (hair thickness: its hair is sculpted)\"],\n"
    "  \"_notes\": {{\n"
    "    \"7.1\": \"a vertex of the nape stands in for the top of the spine, which is inside the head\",\n"
    "    \"11.1-11.3\": \"on the skin under the hair\"\n"
    "  }},\n"
    "  \"points\": {{\n";

template <class Value>
std::string format_points(const Head& head, const std::string& file, Value value) {
    std::string text = fmt::format(preface, head.title, file);
    for (std::size_t i = 0; i < head.points.size(); ++i)
        fmt::format_to(std::back_inserter(text), "    \"{}\": {}{}\n", head.points[i].id, value(head.points[i]),
                       i + 1 < head.points.size() ? "," : "");
    return text + "  }\n}\n";
}

}  // namespace

std::string format_points_by_mesh(const Head& head) {
    return format_points(head, head.name + ".glb", [&](const HeadPoint& p) {
        const Surface& part = head.parts[p.part];
        return fmt::format(R"({{"mesh": "{}", "vertex": {}}})", part.name, vertex_in_glb(part, p.vertex));
    });
}

std::string format_points_by_vertex(const Head& head) {
    return format_points(head, head.name + ".obj", [&](const HeadPoint& p) {
        std::size_t first = 0;
        for (std::size_t i = 0; i < p.part; ++i) first += head.parts[i].positions.size();
        return first + p.vertex;
    });
}

}  // namespace mien::samples
