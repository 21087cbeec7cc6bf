// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/measured_points.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string>

#include "io/json_text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

using nlohmann::json;

[[noreturn]] void fail(const std::string& pointer, const json& found) {
    throw Error(
        fmt::format("measured points {}: expected [x, y, z] of finite numbers, or null for at most two of them, "
                    "found {}",
                    pointer, shown_json(found)));
}

Vec3 read_place(const json& value, const std::string& pointer) {
    if (!value.is_array() || value.size() != 3) fail(pointer, value);
    std::array<double, 3> place{};
    int missing = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        if (value[k].is_null()) {
            place[k] = std::numeric_limits<double>::quiet_NaN();
            ++missing;
            continue;
        }
        constexpr double largest = std::numeric_limits<float>::max();
        if (!value[k].is_number() || !(std::abs(value[k].get<double>()) <= largest)) fail(pointer, value);
        place[k] = value[k].get<double>();
    }
    if (missing == 3) fail(pointer, value);
    return {place[0], place[1], place[2]};
}

}  // namespace

std::vector<MeasuredPoint> parse_measured_points(std::span<const std::byte> bytes) {
    const JsonText text = parse_json_text(bytes, "measured points");
    const bool nested = text.value.contains("points");
    const std::string parent = nested ? "points" : "";
    const json& map = nested ? text.value["points"] : text.value;
    if (!map.is_object()) throw Error("measured points /points: expected an object, found " + shown_json(map));
    std::vector<MeasuredPoint> points;
    for (const std::string& id : keys_of(text, parent))
        points.push_back({id, read_place(map[id], nested ? json_pointer({parent, id}) : json_pointer({id}))});
    if (points.empty()) throw Error("measured points: expected points, found none");
    return points;
}

}  // namespace mien
