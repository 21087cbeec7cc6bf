// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A marker map is JSON when its first letter is a brace, else CSV; a heading line in the CSV does no harm, since a
// name that no take has is ignored.

#include "mien/io/marker_map.hpp"

#include <fmt/format.h>
#include <set>
#include <string>

#include "io/json_text.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

Rename read_line(const Lines& lines) {
    const std::optional<std::vector<std::string>> cells = comma_cells(lines.line());
    if (!cells) lines.fail("expected a closing quote, found the end of the line");
    if (cells->size() != 2) lines.fail(fmt::format("expected two cells, marker and id, found {}", cells->size()));
    if (cells->front().empty()) lines.fail("expected the name of a marker, found nothing");
    return {cells->front(), cells->back()};
}

std::vector<Rename> read_csv(std::span<const std::byte> bytes) {
    check_text(bytes, "marker map");
    Lines lines(as_text(bytes), "marker map");
    std::vector<Rename> names;
    std::set<std::string> seen;
    while (lines.next_filled()) {
        names.push_back(read_line(lines));
        if (!seen.insert(names.back().from).second)
            lines.fail(fmt::format("expected each marker once, found {} twice", shown(names.back().from)));
    }
    return names;
}

// Keys come in file order; the JSON reader has refused any that comes twice.
std::vector<Rename> read_json(std::span<const std::byte> bytes) {
    const JsonText text = parse_json_text(bytes, "marker map");
    if (!text.value.contains("markers") || !text.value["markers"].is_object())
        throw Error("marker map /markers: expected an object, found none");
    std::vector<Rename> names;
    for (const std::string& marker : keys_of(text, "markers")) {
        const nlohmann::json& id = text.value["markers"][marker];
        if (!id.is_string() && !id.is_null())
            throw Error(fmt::format("marker map {}: expected the id of a feature point in quotes, or null, found {}",
                                    json_pointer({"markers", marker}), shown_json(id)));
        if (marker.empty()) throw Error("marker map /markers/: expected the name of a marker, found nothing");
        names.push_back({marker, id.is_null() ? std::string() : id.get<std::string>()});
    }
    return names;
}

}  // namespace

std::vector<Rename> parse_marker_map(std::span<const std::byte> bytes) {
    const bool json = trimmed(as_text(bytes)).starts_with('{');
    std::vector<Rename> names = json ? read_json(bytes) : read_csv(bytes);
    if (names.empty()) throw Error("marker map: expected markers, found none");
    return names;
}

}  // namespace mien
