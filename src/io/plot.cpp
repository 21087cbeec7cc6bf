// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// SVG is written as text; only its size is decided here, since the letters are those of whoever shows it. Widths of
// text are therefore taken from DejaVu Sans, the widest of the families that are asked for.

#include "mien/io/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <string_view>

#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr double largest_value = 1e100;
constexpr double text_size = 12, margin = 20, row = 18;
constexpr std::string_view palette[] = {"#0072b2", "#d55e00", "#009e73", "#e69f00", "#56b4e9", "#cc79a7", "#4d4d4d"};
constexpr std::string_view dashes[] = {"", " stroke-dasharray=\"6 4\"", " stroke-dasharray=\"1 4\""};

// The length of the letter of UTF-8 that begins there, or 0 when XML has no such letter.
std::size_t letter_length(std::string_view text) {
    const auto first = static_cast<unsigned char>(text[0]);
    if (first < 0x80) return first >= 0x20 ? 1 : 0;
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
    std::uint32_t code = first & (0x7FU >> length);
    for (std::size_t i = 1; i < length; ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if ((byte & 0xC0U) != 0x80U) return 0;
        code = code << 6 | (byte & 0x3FU);
    }
    constexpr std::array<std::uint32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = code >= 0xD800 && code < 0xE000, none = code == 0xFFFE || code == 0xFFFF;
    return code >= least[length] && code <= 0x10FFFF && !surrogate && !none ? length : 0;
}

// Text as XML wants it; bytes that are no letters become question marks.
std::string escaped(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t length = letter_length(text);
        if (length == 0)
            result += '?';
        else if (text[0] == '&')
            result += "&amp;";
        else if (text[0] == '<')
            result += "&lt;";
        else if (text[0] == '>')
            result += "&gt;";
        else
            result += text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return result;
}

double text_width(std::string_view text) {
    const auto letters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
    return 0.62 * text_size * static_cast<double>(letters);
}

struct Range {
    double low = 0, high = 0;
    bool empty = true;

    void take(double value) {
        low = empty ? value : std::min(low, value);
        high = empty ? value : std::max(high, value);
        empty = false;
    }
};

// A scale from values to pixels, and its ticks: first to last times step.
struct Axis {
    double low = 0, high = 1, step = 1;
    double at_low = 0, at_high = 1;  // pixels
    std::int64_t first = 0, last = 1;

    [[nodiscard]] double place(double value) const {
        return at_low + (value - low) / (high - low) * (at_high - at_low);
    }
};

// A range that can be divided: nothing becomes 0 to 1, a single value gets room around it.
Range widened(Range range) {
    if (range.empty) return {0, 1, false};
    const double size = std::max(std::abs(range.low), std::abs(range.high));
    if (range.high - range.low > 1e-9 * size) return range;
    const double room = size > 0 ? 0.1 * size : 1;
    return {range.low - room, range.high + room, false};
}

// Heckbert's nice number: 1, 2, 5 or 10 times a power of ten, not below the wanted step.
double nice_step(double wanted) {
    const double power = std::pow(10.0, std::floor(std::log10(wanted)));
    for (const double digit : {1.0, 2.0, 5.0})
        if (digit * power >= wanted * (1 - 1e-9)) return digit * power;
    return 10 * power;
}

constexpr double slack = 1e-6;  // over a step: a value on a tick counts as there

Axis inner_axis(const Range& range, double ticks) {
    Axis axis;
    axis.low = range.low;
    axis.high = range.high;
    axis.step = nice_step((axis.high - axis.low) / ticks);
    axis.first = std::llround(std::ceil(axis.low / axis.step - slack));
    axis.last = std::llround(std::floor(axis.high / axis.step + slack));
    return axis;
}

Axis outer_axis(const Range& range, double ticks) {
    Axis axis = inner_axis(range, ticks);
    axis.first = std::llround(std::floor(axis.low / axis.step + slack));
    axis.last = std::llround(std::ceil(axis.high / axis.step - slack));
    axis.low = static_cast<double>(axis.first) * axis.step;
    axis.high = static_cast<double>(axis.last) * axis.step;
    return axis;
}

Range with_zero(Range range) {
    const double spread = range.high - range.low;
    if (range.low > 0 && range.low <= spread) range.low = 0;
    if (range.high < 0 && -range.high <= spread) range.high = 0;
    return range;
}

std::string tick_text(const Axis& axis, std::int64_t tick) {
    const double value = static_cast<double>(tick) * axis.step;
    const double size = std::max(std::abs(axis.low), std::abs(axis.high));
    const std::string_view sign = tick < 0 ? "\u2212" : "";
    if (size >= 1e7 || size < 1e-4) return fmt::format("{}{:.6g}", sign, std::abs(value));
    const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(axis.step) + 1e-9)));
    return fmt::format("{}{:.{}f}", sign, std::abs(value), decimals);
}

void check(const Plot& plot) {
    if (plot.width < 160 || plot.height < 160 || plot.width > 16384 || plot.height > 16384)
        throw Error(
            fmt::format("plot: expected a width and height from 160 to 16384, found {} x {}", plot.width, plot.height));
    for (const Curve& curve : plot.curves) {
        if (curve.x.size() != curve.y.size())
            throw Error(fmt::format("plot: expected as many y as x in curve {}, found {} and {}", shown(curve.name),
                                    curve.y.size(), curve.x.size()));
        for (const std::vector<double>* values : {&curve.x, &curve.y})
            for (const double value : *values)
                if (std::isfinite(value) && std::abs(value) > largest_value)
                    throw Error(fmt::format("plot: expected values up to {:g} in curve {}, found {:g}", largest_value,
                                            shown(curve.name), value));
    }
}

bool is_seen(const Curve& curve, std::size_t i) {
    return std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]);
}

double legend_width(const Plot& plot) {
    double widest = 0;
    for (const Curve& curve : plot.curves) widest = std::max(widest, text_width(curve.name));
    return widest > 0 ? std::min(widest + 36, plot.width / 3.0) : 0;
}

struct Axes {
    Axis x, y;
};

Axes lay_out(const Plot& plot) {
    Range xs, ys;
    for (const Curve& curve : plot.curves)
        for (std::size_t i = 0; i < curve.x.size(); ++i)
            if (is_seen(curve, i)) {
                xs.take(curve.x[i]);
                ys.take(curve.y[i]);
            }
    const double top = margin + (plot.title.empty() ? 0 : 28) + (plot.y_label.empty() ? 0 : row) + 6;
    const double bottom = plot.height - margin - row - (plot.x_label.empty() ? 0 : row);
    Axes axes{{}, outer_axis(with_zero(widened(ys)), std::clamp((bottom - top) / 60, 2.0, 8.0))};
    double labels = 0;
    for (std::int64_t tick = axes.y.first; tick <= axes.y.last; ++tick)
        labels = std::max(labels, text_width(tick_text(axes.y, tick)));
    const double left = margin + labels + 8, right = plot.width - margin - legend_width(plot);
    axes.x = inner_axis(widened(xs), std::clamp((right - left) / 90, 2.0, 12.0));
    axes.x.at_low = left;
    axes.x.at_high = right;
    axes.y.at_low = bottom;
    axes.y.at_high = top;
    return axes;
}

template <class... Values>
void add(std::string& svg, fmt::format_string<Values...> form, Values&&... values) {
    fmt::format_to(std::back_inserter(svg), form, std::forward<Values>(values)...);
    svg += '\n';
}

void add_text(std::string& svg, double x, double y, std::string_view look, std::string_view text) {
    if (!text.empty()) add(svg, R"(<text x="{:.2f}" y="{:.2f}"{}>{}</text>)", x, y, look, escaped(text));
}

constexpr std::string_view ink = R"( fill="#28282c")";
constexpr std::string_view grey = R"( fill="#77777a")";
constexpr std::string_view grey_middle = R"( fill="#77777a" text-anchor="middle")";
constexpr std::string_view grey_end = R"( fill="#77777a" text-anchor="end")";

void add_frame(std::string& svg, const Plot& plot, const Axes& axes) {
    add_text(svg, margin, margin + 16, R"( font-size="18" font-weight="bold")", plot.title);
    add_text(svg, margin, axes.y.at_high - 12, grey, plot.y_label);
    add_text(svg, (axes.x.at_low + axes.x.at_high) / 2, axes.y.at_low + 2 * row + 2, grey_middle, plot.x_label);
    for (std::int64_t tick = axes.y.first; tick <= axes.y.last; ++tick) {
        const double y = axes.y.place(static_cast<double>(tick) * axes.y.step);
        const bool strong = tick == 0 || tick == axes.y.first;
        add(svg, R"(<path d="M{:.2f} {:.2f}H{:.2f}" stroke="{}"/>)", axes.x.at_low, y, axes.x.at_high,
            strong ? "#a9a9ad" : "#e4e2de");
        add_text(svg, axes.x.at_low - 8, y + 4, grey_end, tick_text(axes.y, tick));
    }
    for (std::int64_t tick = axes.x.first; tick <= axes.x.last; ++tick) {
        const double x = axes.x.place(static_cast<double>(tick) * axes.x.step);
        add(svg, R"(<path d="M{:.2f} {:.2f}v5" stroke="#a9a9ad"/>)", x, axes.y.at_low);
        add_text(svg, x, axes.y.at_low + row, grey_middle, tick_text(axes.x, tick));
    }
}

std::string_view colour_of(std::size_t curve) {
    return palette[curve % std::size(palette)];
}

std::string stroke(std::size_t curve) {
    return fmt::format(R"( stroke="{}"{})", colour_of(curve), dashes[curve / std::size(palette) % std::size(dashes)]);
}

// A gap ends the line; a value alone between gaps is a dot: a line of no length with round ends.
void add_curve(std::string& svg, const Curve& curve, const Axes& axes, std::size_t number) {
    std::string line, dots;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
        if (!is_seen(curve, i)) continue;
        const bool begins = i == 0 || !is_seen(curve, i - 1);
        const bool alone = begins && (i + 1 == curve.x.size() || !is_seen(curve, i + 1));
        fmt::format_to(std::back_inserter(alone ? dots : line), "{}{:.2f} {:.2f}{}", begins ? 'M' : 'L',
                       axes.x.place(curve.x[i]), axes.y.place(curve.y[i]), alone ? "h0" : "");
    }
    if (!line.empty()) add(svg, R"(<path class="curve" d="{}"{}/>)", line, stroke(number));
    if (!dots.empty()) add(svg, R"(<path class="dots" d="{}" stroke-width="4" stroke="{}"/>)", dots, colour_of(number));
}

void add_legend(std::string& svg, const Plot& plot, const Axes& axes) {
    if (legend_width(plot) == 0) return;
    const double left = axes.x.at_high + 14;
    const auto room = static_cast<std::size_t>((axes.y.at_low - axes.y.at_high) / row);
    const std::size_t count = plot.curves.size() <= room ? plot.curves.size() : room - 1;
    double y = axes.y.at_high + 4;
    for (std::size_t c = 0; c < count; ++c, y += row) {
        add(svg, R"(<path d="M{:.2f} {:.2f}h14"{}/>)", left, y - 4, stroke(c));
        add_text(svg, left + 20, y, ink, plot.curves[c].name);
    }
    if (count < plot.curves.size())
        add_text(svg, left + 20, y, grey, fmt::format("and {} more", plot.curves.size() - count));
}

}  // namespace

std::string format_plot(const Plot& plot) {
    check(plot);
    const Axes axes = lay_out(plot);
    std::string svg;
    add(svg, R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}")", plot.width,
        plot.height);
    add(svg, R"(  font-family="DejaVu Sans, Verdana, sans-serif" font-size="{}" fill="#28282c">)", text_size);
    add(svg, R"(<rect width="100%" height="100%" fill="#faf9f7"/>)");
    add_frame(svg, plot, axes);
    add(svg, R"(<g fill="none" stroke-width="1.6" stroke-linejoin="round" stroke-linecap="round">)");
    for (std::size_t c = 0; c < plot.curves.size(); ++c) add_curve(svg, plot.curves[c], axes, c);
    add_legend(svg, plot, axes);
    add(svg, "</g>\n</svg>");
    return svg;
}

}  // namespace mien
