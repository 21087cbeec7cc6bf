// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "evaluate_table.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mien::cli {

namespace {

Report as_report(const RegionFigures& region) {
    return {{"region", region.name},
            {"vertices", region.vertices},
            {"error", region.error},
            {"p95", region.p95},
            {"max", region.max}};
}

Report as_report(const ShapeFigures& shape) {
    Report report = {{"shape", shape.shape},     {"error", shape.error},      {"p95", shape.p95},
                     {"max", shape.max},         {"flipped", shape.flipped},  {"lid_gap", shape.lid_gap},
                     {"lip_gap", shape.lip_gap}, {"crossing", shape.crossing}};
    for (const RegionFigures& region : shape.regions) report["regions"].push_back(as_report(region));
    return report;
}

std::size_t name_width(std::span<const Evaluation> evaluations) {
    std::size_t width = 10;
    for (const Evaluation& evaluation : evaluations)
        for (const ShapeFigures& shape : evaluation.shapes) width = std::max(width, shape.shape.size());
    return width;
}

// One method: a line of figures. Flipped faces in percent.
template <class Figures>
std::string figures_line(const std::string& name, std::size_t width, const Figures& f) {
    return fmt::format("{:<{}} {:>7.3f} {:>7.4f} {:>7.4f} {:>8.2f} {:>7.4f} {:>7.4f} {:>8.4f}\n", name, width, f.error,
                       f.p95, f.max, 100 * f.flipped, f.lid_gap, f.lip_gap, f.crossing);
}

std::string heading(const std::string& name, std::size_t width) {
    return fmt::format("{:<{}} {:>7} {:>7} {:>7} {:>8} {:>7} {:>7} {:>8}\n", name, width, "error", "p95", "max",
                       "flipped%", "lids", "lips", "crossing");
}

std::string region_lines(std::span<const RegionFigures> regions, std::size_t width, const std::string& indent) {
    std::string lines;
    for (const RegionFigures& region : regions)
        lines += fmt::format("{}{:<{}} {:>7.3f} {:>7.4f} {:>7.4f}\n", indent, region.name, width - indent.size(),
                             region.error, region.p95, region.max);
    return lines;
}

std::string one_method(const Evaluation& evaluation, bool whole) {
    const std::size_t width = std::max(name_width(std::span(&evaluation, 1)), evaluation.method.size());
    std::string text = heading(evaluation.method, width);
    for (const ShapeFigures& shape : evaluation.shapes) {
        text += figures_line(shape.shape, width, shape);
        if (whole) text += region_lines(shape.regions, width, "  ");
    }
    text += figures_line("all", width, evaluation);
    text += fmt::format("\n{:<{}} {:>7} {:>7} {:>7}\n", "region", width, "error", "p95", "max");
    return text + region_lines(evaluation.regions, width, "");
}

std::string side_by_side(std::span<const Evaluation> evaluations) {
    const std::size_t width = name_width(evaluations);
    std::string text = fmt::format("{:<{}}", "error", width);
    for (const Evaluation& evaluation : evaluations) text += fmt::format("  {}", evaluation.method);
    text += "\n";
    const auto line = [&](const std::string& name, auto figure) {
        text += fmt::format("{:<{}}", name, width);
        for (const Evaluation& evaluation : evaluations)
            text += fmt::format("  {:>{}.3f}", figure(evaluation), evaluation.method.size());
        text += "\n";
    };
    for (std::size_t s = 0; s < evaluations.front().shapes.size(); ++s)
        line(evaluations.front().shapes[s].shape, [&](const Evaluation& e) { return e.shapes[s].error; });
    line("all", [](const Evaluation& e) { return e.error; });
    return text + "\n";
}

std::string summary(std::span<const Evaluation> evaluations) {
    std::size_t width = 10;
    for (const Evaluation& evaluation : evaluations) width = std::max(width, evaluation.method.size());
    std::string text = heading("method", width);
    for (const Evaluation& evaluation : evaluations) text += figures_line(evaluation.method, width, evaluation);
    return text;
}

constexpr const char* legend =
    "\nerror: of RMS motion, 0 exact, 1 as bad as not moving; p95, max, and what lids and lips open differently and "
    "cross by: eye distances\n";

}  // namespace

Report as_report(const Evaluation& evaluation) {
    Report report = {
        {"method", evaluation.method},   {"error", evaluation.error},     {"pooled", evaluation.pooled},
        {"p95", evaluation.p95},         {"max", evaluation.max},         {"flipped", evaluation.flipped},
        {"lid_gap", evaluation.lid_gap}, {"lip_gap", evaluation.lip_gap}, {"crossing", evaluation.crossing}};
    for (const RegionFigures& region : evaluation.regions) report["regions"].push_back(as_report(region));
    for (const ShapeFigures& shape : evaluation.shapes) report["shapes"].push_back(as_report(shape));
    if (!evaluation.still.empty()) report["still"] = evaluation.still;
    return report;
}

std::string as_table(std::span<const Evaluation> evaluations, bool whole) {
    std::string text;
    if (evaluations.size() > 1) text = side_by_side(evaluations) + summary(evaluations);
    if (evaluations.size() == 1 || whole)
        for (const Evaluation& evaluation : evaluations)
            text += fmt::format("{}{}", text.empty() ? "" : "\n", one_method(evaluation, whole));
    return text + legend;
}

}  // namespace mien::cli
