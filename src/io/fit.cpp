// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/fit.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "io/json_text.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

using nlohmann::json;

[[noreturn]] void fail_at(const std::string& place, std::string_view sentence) {
    throw Error(fmt::format("fit{}{}: {}", place.empty() ? "" : " ", place, sentence));
}

// A value with the place where it lies.
struct Node {
    const json& value;
    std::string place;

    [[noreturn]] void fail(std::string_view expected) const {
        fail_at(place, fmt::format("expected {}, found {}", expected, shown_json(value)));
    }
};

// An object with all of the keys `needed` and none but those and `optional`.
void check_keys(const Node& node, std::initializer_list<std::string_view> needed,
                std::initializer_list<std::string_view> optional) {
    if (!node.value.is_object()) node.fail("an object");
    std::vector<std::string_view> known(needed);
    known.insert(known.end(), optional.begin(), optional.end());
    for (const std::string_view key : needed)
        if (!node.value.contains(key)) fail_at(node.place, fmt::format("expected the key {}, found none", key));
    for (const auto& member : node.value.items()) {
        const std::string_view key = member.key();
        if (key.starts_with('_') || std::find(known.begin(), known.end(), key) != known.end()) continue;
        fail_at(node.place + json_pointer({key}),
                fmt::format("expected none but the keys {}, found another", fmt::join(known, ", ")));
    }
}

Node member(const Node& node, std::string_view key) {
    return {node.value[std::string(key)], node.place + json_pointer({key})};
}

// What `read` makes of each element of an array, which has no more of them than anything may have.
template <class Read>
auto read_array(const Node& node, const Read& read) {
    if (!node.value.is_array()) node.fail("an array");
    if (node.value.size() > most_fit_links)
        fail_at(node.place, fmt::format("expected at most {} elements, found {}", most_fit_links, node.value.size()));
    std::vector<decltype(read(node))> elements;
    for (const json& element : node.value)
        elements.push_back(read(Node{element, fmt::format("{}/{}", node.place, elements.size())}));
    return elements;
}

std::int32_t read_integer(const Node& node) {
    using Limits = std::numeric_limits<std::int32_t>;
    const json& value = node.value;
    const bool fits = value.is_number_unsigned()
                          ? value.get<std::uint64_t>() <= std::uint64_t{Limits::max()}
                          : value.is_number_integer() && value.get<std::int64_t>() >= Limits::min();
    if (!fits) node.fail("a whole number of 32 bits");
    return value.get<std::int32_t>();
}

double read_number(const Node& node) {
    if (!node.value.is_number()) node.fail("a number");
    return node.value.get<double>();
}

FitImpulse read_impulse(const Node& node) {
    check_keys(node, {"fap", "value"}, {});
    return {read_integer(member(node, "fap")), read_integer(member(node, "value"))};
}

FitTerm read_term(const Node& node) {
    check_keys(node, {"coefficient"}, {"exponents", "impulse"});
    FitTerm term;
    term.coefficient = read_number(member(node, "coefficient"));
    if (node.value.contains("exponents")) term.exponents = read_array(member(node, "exponents"), read_integer);
    if (node.value.contains("impulse")) term.impulse = read_impulse(member(node, "impulse"));
    return term;
}

FitTarget read_target(const Node& node) {
    check_keys(node, {"fap", "numerator"}, {"denominator"});
    FitTarget target;
    target.fap = read_integer(member(node, "fap"));
    target.numerator = read_array(member(node, "numerator"), read_term);
    if (node.value.contains("denominator")) target.denominator = read_array(member(node, "denominator"), read_term);
    return target;
}

FitLink read_link(const Node& node) {
    check_keys(node, {"from", "to"}, {});
    return {read_array(member(node, "from"), read_integer), read_array(member(node, "to"), read_target)};
}

}  // namespace

FapInterpolation parse_fit(std::span<const std::byte> bytes) {
    const JsonText text = parse_json_text(bytes, "fit");
    const Node file{text.value, ""};
    check_keys(file, {"links"}, {});
    FapInterpolation fit{read_array(member(file, "links"), read_link)};
    if (fit.links.empty()) fail_at("/links", "expected links, found none");
    interpolated_faps(fit);
    return fit;
}

namespace {

void append_term(std::string& text, const FitTerm& term) {
    text += R"({"coefficient": )";
    append_number(text, term.coefficient);
    if (!term.exponents.empty()) text += fmt::format(R"(, "exponents": [{}])", fmt::join(term.exponents, ", "));
    if (term.impulse)
        text += fmt::format(R"(, "impulse": {{"fap": {}, "value": {}}})", term.impulse->fap, term.impulse->value);
    text += "}";
}

void append_sum(std::string& text, std::string_view name, const std::vector<FitTerm>& sum) {
    if (sum.empty()) return;
    text += fmt::format(R"(, "{}": [)", name);
    for (std::size_t i = 0; i < sum.size(); ++i) {
        if (i > 0) text += ", ";
        append_term(text, sum[i]);
    }
    text += "]";
}

void append_link(std::string& text, const FitLink& link) {
    text += fmt::format("\n    {{\"from\": [{}], \"to\": [", fmt::join(link.from, ", "));
    for (std::size_t i = 0; i < link.to.size(); ++i) {
        text += fmt::format("{}\n      {{\"fap\": {}", i > 0 ? "," : "", link.to[i].fap);
        append_sum(text, "numerator", link.to[i].numerator);
        append_sum(text, "denominator", link.to[i].denominator);
        text += "}";
    }
    text += "\n    ]}";
}

}  // namespace

std::string format_fit(const FapInterpolation& fit) {
    std::string text = "{\n  \"links\": [";
    for (std::size_t i = 0; i < fit.links.size(); ++i) {
        if (i > 0) text += ",";
        append_link(text, fit.links[i]);
    }
    return text + "\n  ]\n}\n";
}

}  // namespace mien
