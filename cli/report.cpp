// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "report.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mien::cli {

namespace {

constexpr std::size_t short_list = 12;

std::string words(std::string key) {
    std::replace(key.begin(), key.end(), '_', ' ');
    return key;
}

std::string scalar(const Report& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
    return value.dump();
}

std::string one_line(const Report& object) {
    std::string line;
    for (const auto& [key, value] : object.items())
        line += fmt::format("{}{} {}", line.empty() ? "" : ", ", words(key), scalar(value));
    return line;
}

std::string list_lines(const Report& list, const std::string& indent, bool whole) {
    const bool a_line_each = std::any_of(list.begin(), list.end(), [](const Report& item) {
        return item.is_object() || (item.is_string() && item.get_ref<const std::string&>().size() > 24);
    });
    const std::string between = a_line_each ? fmt::format("\n{}  ", indent) : " ";
    const std::size_t shown = whole ? list.size() : std::min(list.size(), short_list);
    std::string out;
    for (std::size_t i = 0; i < shown; ++i)
        out += between + (list[i].is_object() ? one_line(list[i]) : scalar(list[i]));
    if (shown < list.size()) out += between + fmt::format("and {} more (-v shows all)", list.size() - shown);
    return out + "\n";
}

std::string lines(const Report& report, const std::string& indent, bool whole) {
    std::string out;
    for (const auto& [key, value] : report.items()) {
        out += indent + words(key) + ":";
        if (value.is_object())
            out.append("\n").append(lines(value, indent + "  ", whole));
        else if (value.is_array())
            out += list_lines(value, indent, whole);
        else
            out += fmt::format(" {}\n", scalar(value));
    }
    return out;
}

}  // namespace

std::string as_lines(const Report& report, bool whole) {
    return lines(report, "", whole);
}

std::string as_json(const Report& report) {
    return report.dump(2, ' ', false, Report::error_handler_t::replace) + "\n";
}

void warn(Report& report, const std::string& sentence) {
    report["warnings"].push_back(sentence);
}

}  // namespace mien::cli
