// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "parts.hpp"

#include <charconv>
#include <optional>
#include <sstream>
#include <utility>

#include "mien/algorithms/depth.hpp"
#include "mien/algorithms/partial.hpp"

namespace mien::cli {

namespace {

std::vector<std::string> by_commas(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream words(text);
    for (std::string part; std::getline(words, part, ',');)
        if (!part.empty()) parts.push_back(part);
    return parts;
}

std::vector<std::string> by_commas(const std::vector<std::string>& texts) {
    std::vector<std::string> parts;
    for (const std::string& text : texts)
        for (std::string& part : by_commas(text)) parts.push_back(std::move(part));
    return parts;
}

std::optional<PartStrength> part_strength(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) return std::nullopt;
    PartStrength result{text.substr(0, equals), 0};
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data() + equals + 1, end, result.strength);
    return read.ec == std::errc() && read.ptr == end ? std::optional(result) : std::nullopt;
}

std::string check_strength(const std::string& texts) {
    for (const std::string& text : by_commas(texts))
        if (!part_strength(text)) return "expected a name and a number, as in mouth=1.2; found " + text;
    return {};
}

}  // namespace

std::vector<PartStrength> part_strengths(const std::vector<std::string>& texts) {
    std::vector<PartStrength> result;
    for (const std::string& text : by_commas(texts))
        if (const auto number = part_strength(text)) result.push_back(*number);
    return result;
}

CLI::Option* add_strength_flag(CLI::App& verb, std::vector<std::string>& strengths, const std::string& help) {
    return verb.add_option("--strength", strengths, help)
        ->allow_extra_args(false)
        ->check(CLI::Validator(check_strength, "PART=NUMBER"));
}

namespace {

PartialOptions partial_options(const PerformanceFlags& flags, std::size_t take) {
    PartialOptions options;
    options.only = flags.takes.size() > 1 && !flags.only.empty() ? by_commas(flags.only[take]) : by_commas(flags.only);
    options.without = by_commas(flags.without);
    options.strengths = part_strengths(flags.strengths);
    return options;
}

void refuse_uneven(const PerformanceFlags& flags) {
    if (flags.takes.size() > 1 && flags.only.size() != flags.takes.size())
        throw CLI::ValidationError("--only", "several takes need one --only each, in their order");
}

}  // namespace

void add_performance_flags(CLI::App& verb, PerformanceFlags& flags, const std::string& take_name) {
    verb.add_option(
            take_name, flags.takes,
            "the performance: .trc .csv .c3d; several are merged, each with an --only of its own, at the times of "
            "the first")
        ->required()
        ->allow_extra_args(!take_name.starts_with("--"));
    add_take_flags(verb, flags.take);
    add_retarget_flags(verb, flags.retarget);
    verb.add_option(
            "--only", flags.only,
            "the parts of the face that move, by commas: mouth, jaw, brows, lids, eyes, nose, cheeks, or points")
        ->allow_extra_args(false);
    verb.add_option("--without", flags.without, "the parts that do not move, by commas")->allow_extra_args(false);
    add_strength_flag(verb, flags.strengths, "how strongly parts move, by commas: mouth=1.2,brows=0.5");
    verb.add_option(
            "--sealed", flags.sealed,
            "how far the lips of a face whose mouth is open at rest stay open when the performer's are closed, in "
            "eye distances, per upper point of a pair: 2.2=0.02,2.6=0.02,2.7=0.02")
        ->allow_extra_args(false)
        ->check(CLI::Validator(check_strength, "POINT=NUMBER"));
    verb.add_flag_callback(
        "--no-depth", [&flags] { flags.depth = false; },
        "leave the points of a picture (a take without z) in their plane, instead of estimating their depth");
    verb.parse_complete_callback([&flags] { refuse_uneven(flags); });
}

std::vector<std::filesystem::path> input_files(const PerformanceFlags& flags) {
    std::vector<std::filesystem::path> files = flags.takes;
    files.push_back(flags.take.map);
    return files;
}

namespace {

Take load_one(const PerformanceFlags& flags, std::size_t i, const Face& face, Report& report) {
    TakeFlags one = flags.take;
    one.take = flags.takes[i];
    Take take = load_take(one, report);
    if (take.planar) {
        if (flags.depth) take = with_depth(take, one.neutral);
        report["depth"] = take.planar ? "none: the picture's points stay in a plane" : "estimated from the picture";
    }
    const PartialOptions parts = partial_options(flags, i);
    if (!parts.only.empty() || !parts.without.empty() || !parts.strengths.empty())
        take = partial(take, neutral(take, one.neutral), parts);
    RetargetOptions options = flags.retarget;
    options.neutral = one.neutral;
    for (const PartStrength& pair : part_strengths(flags.sealed)) options.sealed.push_back({pair.part, pair.strength});
    return load_onto(take, face, options, report);
}

}  // namespace

Take load_performance(const PerformanceFlags& flags, const Face& face, Report& report) {
    Take onto = load_one(flags, 0, face, report);
    for (std::size_t i = 1; i < flags.takes.size(); ++i) {
        Report more;
        const Take other = load_one(flags, i, face, more);
        report["merged"].push_back(more);
        onto = merged(onto, other, by_commas(flags.only[i]));
    }
    return onto;
}

}  // namespace mien::cli
