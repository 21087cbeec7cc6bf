// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The rig in the extension MIEN_rig (docs/rig-file.md). Short things are JSON, rows of weights are buffer views. The
// file may come from a stranger: what a rig promises (mien/rig.hpp) is checked here number by number.

#include "io/rig_extension.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "io/gltf_json.hpp"
#include "io/json_text.hpp"
#include "io/rig_arrays.hpp"

namespace mien {

namespace {

using nlohmann::json;

json to_json(const Vec3& v) {
    return {v.x, v.y, v.z};
}

std::string letters(const Axes& axes) {
    return std::string(axes.x ? "x" : "") + (axes.y ? "y" : "") + (axes.z ? "z" : "");
}

json written_point(const FeaturePoint& point) {
    return {{"id", point.id},
            {"vertex", point.vertex},
            {"position", to_json(point.position)},
            {"moves", letters(point.moves)},
            {"snapped", point.snapped}};
}

json append_eyeball(GltfDocument& document, const Eyeball& eyeball) {
    json written = {{"name", eyeball.name}, {"centre", to_json(eyeball.centre)}};
    if (eyeball.point) written["point"] = *eyeball.point;
    written["vertices"] = append_array(document, eyeball.vertices);
    return written;
}

const json& required(const json& object, const char* name, const std::string& pointer, const char* expected) {
    const json* found = find_member(object, name, pointer);
    if (found == nullptr) fail_at(pointer + '/' + name, expected, "none");
    return *found;
}

std::string required_text(const json& object, const char* name, const std::string& pointer) {
    required(object, name, pointer, "a text");
    return text_member(object, name, pointer);
}

double finite_number(const json& value, const std::string& pointer) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) fail_found(pointer, "a finite number", value);
    return value.get<double>();
}

Vec3 vector_member(const json& object, const char* name, const std::string& pointer) {
    const json& value = required(object, name, pointer, "three numbers");
    const std::string place = pointer + '/' + name;
    if (!value.is_array() || value.size() != 3) fail_found(place, "three numbers", value);
    return {finite_number(value[0], place + "/0"), finite_number(value[1], place + "/1"),
            finite_number(value[2], place + "/2")};
}

// A whole number up to `most`.
std::uint32_t limited(const json& object, const char* name, const std::string& pointer, std::size_t most) {
    const std::uint64_t value = whole_member(object, name, pointer);
    if (value > most) fail_at(pointer + '/' + name, fmt::format("at most {}", most), fmt::format("{}", value));
    return static_cast<std::uint32_t>(value);
}

// An index into a list of `count`.
std::uint32_t index_member(const json& object, const char* name, const std::string& pointer, std::size_t count) {
    if (count == 0) fail_at(pointer + '/' + name, "none, because there is nothing to count", "a number");
    return limited(object, name, pointer, count - 1);
}

Axes read_axes(const json& object, const std::string& pointer) {
    const std::string text = required_text(object, "moves", pointer);
    const auto has = [&](char axis) { return text.find(axis) != std::string::npos; };
    const Axes axes{has('x'), has('y'), has('z')};
    if (letters(axes) != text) fail_found(pointer + "/moves", "letters of \"xyz\" in that order", object["moves"]);
    return axes;
}

FeaturePoint read_point(const json& written, const std::string& pointer, std::size_t vertices) {
    FeaturePoint point;
    point.id = required_text(written, "id", pointer);
    point.vertex = index_member(written, "vertex", pointer, vertices);
    point.position = vector_member(written, "position", pointer);
    point.moves = read_axes(written, pointer);
    point.snapped = finite_number(required(written, "snapped", pointer, "a number"), pointer + "/snapped");
    if (point.snapped < 0) fail_found(pointer + "/snapped", "0 or more", written["snapped"]);
    return point;
}

void check_ids(const std::vector<FeaturePoint>& points) {
    std::vector<std::string_view> ids;
    ids.reserve(points.size());
    for (const FeaturePoint& point : points) ids.emplace_back(point.id);
    std::sort(ids.begin(), ids.end());
    const auto twice = std::adjacent_find(ids.begin(), ids.end());
    if (twice != ids.end())
        fail_at(std::string(rig_pointer) + "/points", "each id once", json_pointer({*twice}) + " twice");
}

void read_points(const json& extension, Rig& rig) {
    const json& written = array_member(extension, "points", rig_pointer);
    for (std::size_t i = 0; i < written.size(); ++i)
        rig.points.push_back(read_point(written[i], fmt::format("{}/points/{}", rig_pointer, i), rig.rest.size()));
    check_ids(rig.points);
}

void check_finite(const std::vector<Vec3f>& values, const char* name) {
    const auto bad = std::find_if_not(values.begin(), values.end(), is_finite<float>);
    if (bad != values.end())
        fail_at(fmt::format("{}/{}", rig_pointer, name), "finite numbers",
                fmt::format("another in element {}", bad - values.begin()));
}

void check_counts(const Rig& rig) {
    const auto check = [](const char* name, std::size_t expected, std::size_t found) {
        if (found != expected)
            fail_at(fmt::format("{}/{}/count", rig_pointer, name), fmt::format("{}", expected),
                    fmt::format("{}", found));
    };
    check("rowStarts", rig.rest.size() + 1, rig.row_starts.size());
    check("rowPoints", rig.row_starts.back(), rig.row_points.size());
    check("weights", rig.row_points.size(), rig.weights.size());
}

void check_row_starts(const Rig& rig) {
    const std::string place = fmt::format("{}/rowStarts", rig_pointer);
    if (rig.row_starts.front() != 0) fail_at(place, "0 first", fmt::format("{}", rig.row_starts.front()));
    const auto falls = std::adjacent_find(rig.row_starts.begin(), rig.row_starts.end(), std::greater<>());
    if (falls != rig.row_starts.end())
        fail_at(place, "numbers that never fall", fmt::format("{} before {}", falls[0], falls[1]));
}

void check_row_points(const Rig& rig) {
    const std::string place = fmt::format("{}/rowPoints", rig_pointer);
    for (std::size_t v = 0; v < rig.rest.size(); ++v)
        for (std::size_t i = rig.row_starts[v]; i < rig.row_starts[v + 1]; ++i) {
            if (rig.row_points[i] >= rig.points.size())
                fail_at(place, fmt::format("numbers of {} points", rig.points.size()),
                        fmt::format("{} in element {}", rig.row_points[i], i));
            if (i > rig.row_starts[v] && rig.row_points[i - 1] >= rig.row_points[i])
                fail_at(place, "points that rise within a row", fmt::format("another order in element {}", i));
        }
}

void read_rows(const GltfDocument& document, const json& extension, Rig& rig) {
    rig.row_starts = read_array<std::uint32_t>(document, extension, "rowStarts", rig_pointer);
    rig.row_points = read_array<std::uint16_t>(document, extension, "rowPoints", rig_pointer);
    rig.weights = read_array<Vec3f>(document, extension, "weights", rig_pointer);
    if (rig.row_starts.empty()) fail_at(fmt::format("{}/rowStarts/count", rig_pointer), "1 or more", "0");
    check_counts(rig);
    check_row_starts(rig);
    check_row_points(rig);
    check_finite(rig.weights, "weights");
}

// Marks the vertices of an eyeball; no vertex belongs to two, nor moves with the skin.
void take_vertices(const Eyeball& eyeball, const Rig& rig, const std::string& pointer, std::vector<bool>& taken) {
    const std::string place = pointer + "/vertices";
    for (std::size_t i = 0; i < eyeball.vertices.size(); ++i) {
        const std::uint32_t v = eyeball.vertices[i];
        const auto fail = [&](std::string_view expected) {
            fail_at(place, expected, fmt::format("{} in element {}", v, i));
        };
        if (v >= taken.size()) fail(fmt::format("vertices below {}", taken.size()));
        if (i > 0 && eyeball.vertices[i - 1] >= v) fail("vertices that rise");
        if (taken[v]) fail("vertices that no other eyeball has");
        if (rig.row_starts[v] != rig.row_starts[v + 1]) fail("vertices without weights");
        taken[v] = true;
    }
}

Eyeball read_eyeball(const GltfDocument& document, const json& written, const std::string& pointer,
                     std::size_t points) {
    Eyeball eyeball;
    eyeball.name = required_text(written, "name", pointer);
    eyeball.centre = vector_member(written, "centre", pointer);
    if (written.contains("point")) eyeball.point = index_member(written, "point", pointer, points);
    eyeball.vertices = read_array<std::uint32_t>(document, written, "vertices", pointer);
    return eyeball;
}

void read_eyeballs(const GltfDocument& document, const json& extension, Rig& rig) {
    std::vector<bool> taken(rig.rest.size(), false);
    const json& written = array_member(extension, "eyeballs", rig_pointer);
    for (std::size_t i = 0; i < written.size(); ++i) {
        const std::string pointer = fmt::format("{}/eyeballs/{}", rig_pointer, i);
        rig.eyeballs.push_back(read_eyeball(document, written[i], pointer, rig.points.size()));
        // Checked one by one, so that many eyeballs that name one long view cannot fill the memory.
        take_vertices(rig.eyeballs.back(), rig, pointer, taken);
    }
}

void read_attachments(const json& extension, Rig& rig) {
    const json& written = array_member(extension, "attachments", rig_pointer);
    for (std::size_t i = 0; i < written.size(); ++i) {
        const std::string pointer = fmt::format("{}/attachments/{}", rig_pointer, i);
        rig.attachments.push_back({required_text(written[i], "name", pointer),
                                   required_text(written[i], "how", pointer),
                                   limited(written[i], "vertices", pointer, rig.rest.size())});
    }
}

}  // namespace

json append_rig(GltfDocument& document, const Rig& rig) {
    json written = {{"version", 1}, {"method", rig.method}, {"unreached", rig.unreached}};
    written["points"] = json::array();
    for (const FeaturePoint& point : rig.points) written["points"].push_back(written_point(point));
    written["rest"] = append_array(document, rig.rest);
    written["rowStarts"] = append_array(document, rig.row_starts);
    written["rowPoints"] = append_array(document, rig.row_points);
    written["weights"] = append_array(document, rig.weights);
    written["eyeballs"] = json::array();
    for (const Eyeball& eyeball : rig.eyeballs) written["eyeballs"].push_back(append_eyeball(document, eyeball));
    written["attachments"] = json::array();
    for (const Attachment& each : rig.attachments)
        written["attachments"].push_back({{"name", each.name}, {"how", each.how}, {"vertices", each.vertices}});
    if (rig.prior) written["prior"] = append_prior(document, *rig.prior);
    return written;
}

Rig read_rig_extension(const GltfDocument& document, const json& extension) {
    if (whole_member(extension, "version", rig_pointer) != 1)
        fail_found(fmt::format("{}/version", rig_pointer), "1", extension["version"]);
    Rig rig;
    rig.method = required_text(extension, "method", rig_pointer);
    rig.rest = read_array<Vec3f>(document, extension, "rest", rig_pointer);
    check_finite(rig.rest, "rest");
    read_points(extension, rig);
    read_rows(document, extension, rig);
    read_eyeballs(document, extension, rig);
    read_attachments(extension, rig);
    rig.unreached = limited(extension, "unreached", rig_pointer, rig.rest.size());
    if (const json* prior = find_member(extension, "prior", rig_pointer)) rig.prior = read_prior(document, *prior, rig);
    return rig;
}

}  // namespace mien
