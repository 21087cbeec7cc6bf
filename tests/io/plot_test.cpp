// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>
#include <string_view>

#include "mien/error.hpp"

namespace mien {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Plot plot_of(std::vector<double> x, std::vector<double> y) {
    return {.curves = {{"curve", std::move(x), std::move(y)}}};
}

// The elements of a kind, each of which the file has on a line of its own.
std::vector<std::string> elements(const std::string& svg, std::string_view beginning) {
    std::vector<std::string> result;
    std::istringstream lines(svg);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(beginning)) result.push_back(line);
    return result;
}

std::string between(const std::string& text, const std::string& before, const std::string& after) {
    const std::size_t at = text.find(before);
    if (at == std::string::npos) return {};
    const std::size_t from = at + before.size();
    return text.substr(from, text.find(after, from) - from);
}

std::string attribute(const std::string& element, const std::string& name) {
    return between(element, ' ' + name + "=\"", "\"");
}

// A tick: the number that is written there and where it stands.
struct Tick {
    double value, place;
};

double number(std::string text) {
    if (text.starts_with("\u2212")) text.replace(0, 3, "-");
    return std::stod(text);
}

std::vector<Tick> ticks(const std::string& svg, const std::string& anchor, const std::string& axis) {
    std::vector<Tick> result;
    for (const std::string& text : elements(svg, "<text"))
        if (attribute(text, "text-anchor") == anchor)
            result.push_back({number(between(text, ">", "<")), std::stod(attribute(text, axis))});
    return result;
}

std::vector<Tick> x_ticks(const std::string& svg) {
    return ticks(svg, "middle", "x");
}

std::vector<Tick> y_ticks(const std::string& svg) {
    std::vector<Tick> result = ticks(svg, "end", "y");
    for (Tick& tick : result) tick.place -= 4;  // from the letters' foot to the line
    return result;
}

struct Point {
    double x, y;
    char how;  // 'M' begins a line, 'L' goes on
};

std::vector<Point> points(const std::string& svg, const std::string& kind) {
    std::vector<Point> result;
    for (const std::string& path : elements(svg, "<path class=\"" + kind)) {
        std::istringstream d(attribute(path, "d"));
        Point point{};
        while (d >> point.how)
            if (point.how == 'h')
                d.ignore(1);
            else if (d >> point.x >> point.y)
                result.push_back(point);
    }
    return result;
}

// The value at a place, by the first and the last tick.
double value_at(const std::vector<Tick>& marks, double place) {
    const Tick &a = marks.front(), &b = marks.back();
    return a.value + (place - a.place) / (b.place - a.place) * (b.value - a.value);
}

TEST(Plot, puts_every_value_where_the_ticks_say) {
    const std::vector<double> x = {0, 0.5, 2, 3.7, 8.2}, y = {-3, 0.25, 11.5, 7, -1};
    const std::string svg = format_plot(plot_of(x, y));
    const std::vector<Point> drawn = points(svg, "curve");
    ASSERT_EQ(drawn.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(value_at(x_ticks(svg), drawn[i].x), x[i], 0.001);
        EXPECT_NEAR(value_at(y_ticks(svg), drawn[i].y), y[i], 0.001);
    }
}

TEST(Plot, steps_by_one_two_or_five_times_a_power_of_ten_at_every_size) {
    double size = 1e-90;
    for (int i = 0; i < 210; ++i, size *= 7.3) {
        const std::string svg = format_plot(plot_of({0, size}, {-size / 3, size}));
        for (const std::vector<Tick>& marks : {x_ticks(svg), y_ticks(svg)}) {
            ASSERT_GE(marks.size(), 3U) << size;
            ASSERT_LE(marks.size(), 14U) << size;
            const double step = marks[1].value - marks[0].value;
            const double digit = step / std::pow(10, std::floor(std::log10(step) + 1e-6));
            EXPECT_TRUE(std::abs(digit - 1) < 1e-4 || std::abs(digit - 2) < 1e-4 || std::abs(digit - 5) < 1e-4) << step;
            for (std::size_t t = 1; t < marks.size(); ++t)
                EXPECT_NEAR(marks[t].value - marks[t - 1].value, step, 1e-4 * step) << size;
        }
    }
}

TEST(Plot, encloses_the_values_by_ticks_in_height_and_spans_them_in_width) {
    const std::string svg = format_plot(plot_of({0.3, 7.9}, {104, 117}));
    EXPECT_LE(y_ticks(svg).front().value, 104);
    EXPECT_GT(y_ticks(svg).front().value, 90);
    EXPECT_GE(y_ticks(svg).back().value, 117);
    EXPECT_GE(x_ticks(svg).front().value, 0.3);
    EXPECT_LE(x_ticks(svg).back().value, 7.9);
}

TEST(Plot, begins_at_zero_when_zero_is_near) {
    EXPECT_EQ(y_ticks(format_plot(plot_of({0, 1}, {2, 9}))).front().value, 0);
    EXPECT_EQ(y_ticks(format_plot(plot_of({0, 1}, {-9, -2}))).back().value, 0);
}

TEST(Plot, leaves_gaps_where_values_are_not_finite_and_dots_between_gaps) {
    const double infinity = std::numeric_limits<double>::infinity();
    const std::string svg = format_plot(plot_of({0, 1, 2, 3, 4, 5, nan, 7}, {1, 2, nan, 3, infinity, 4, 5, 6}));
    std::string hows;
    for (const Point& point : points(svg, "curve")) hows += point.how;
    EXPECT_EQ(hows, "ML");
    const std::vector<Point> dots = points(svg, "dots");
    ASSERT_EQ(dots.size(), 3U);
    EXPECT_NEAR(value_at(x_ticks(svg), dots[0].x), 3, 0.01);
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(Plot, of_nothing_or_of_one_value_has_axes_all_the_same) {
    EXPECT_GE(y_ticks(format_plot({})).size(), 2U);
    EXPECT_GE(y_ticks(format_plot(plot_of({nan}, {1}))).size(), 2U);
    for (const double value : {0.0, -5.0, 1e-99, 1e99, 123456.789}) {
        const std::string svg = format_plot(plot_of({value, value}, {value, value}));
        EXPECT_LE(y_ticks(svg).front().value, value * (value < 0 ? 0.999999 : 1.000001)) << value;
        EXPECT_GE(y_ticks(svg).back().value, value * (value < 0 ? 1.000001 : 0.999999)) << value;
    }
}

TEST(Plot, names_its_curves_in_order_as_far_as_there_is_room) {
    Plot plot;
    for (int c = 0; c < 40; ++c) plot.curves.push_back({fmt::format("FAP {}", c), {0, 1}, {0.0, double(c)}});
    const std::string svg = format_plot(plot);
    std::vector<std::string> names;
    for (const std::string& text : elements(svg, "<text"))
        if (between(text, ">", "<").starts_with("FAP")) names.push_back(between(text, ">", "<"));
    ASSERT_GT(names.size(), 8U);
    for (std::size_t n = 0; n < names.size(); ++n) EXPECT_EQ(names[n], fmt::format("FAP {}", n));
    EXPECT_THAT(svg, HasSubstr(fmt::format("and {} more", 40 - names.size())));
    plot.curves.resize(3);
    EXPECT_THAT(format_plot(plot), Not(HasSubstr("more")));
}

TEST(Plot, gives_each_of_21_curves_a_look_of_its_own) {
    Plot plot;
    for (int c = 0; c < 21; ++c) plot.curves.push_back({"", {0, 1}, {0, 1}});
    std::vector<std::string> looks;
    for (const std::string& path : elements(format_plot(plot), "<path class=\"curve\""))
        looks.push_back(attribute(path, "stroke") + ' ' + attribute(path, "stroke-dasharray"));
    std::sort(looks.begin(), looks.end());
    EXPECT_EQ(looks.size(), 21U);
    EXPECT_EQ(std::unique(looks.begin(), looks.end()), looks.end());
}

TEST(Plot, is_xml_whatever_its_names_hold) {
    Plot plot = plot_of({0, 1, nan, 3}, {1, -2e-7, 3, 1e30});
    plot.title = "<b>\"Fran\u00e7ois\" & Co</b> \x01\t\xff\xc0\x80\xed\xa0\x80\xef\xbf\xbf";
    plot.x_label = "x ]]> y";
    plot.curves[0].name = "\xe2\x88";
    const std::string svg = format_plot(plot);
    EXPECT_THAT(svg, HasSubstr("&lt;b&gt;\"Fran\u00e7ois\" &amp; Co&lt;/b&gt; ??????"));
    std::string folder = (std::filesystem::temp_directory_path() / "mien-plot-XXXXXX").string();
    ASSERT_NE(mkdtemp(folder.data()), nullptr);
    std::ofstream(folder + "/plot.svg") << svg;
    const std::string judge = "python3 -c 'import sys, xml.etree.ElementTree as e; e.parse(sys.argv[1])' ";
    EXPECT_EQ(std::system((judge + folder + "/plot.svg").c_str()), 0) << svg;
    std::filesystem::remove_all(folder);
}

TEST(Plot, is_the_same_bytes_twice_and_needs_nothing_from_elsewhere) {
    const Plot plot = plot_of({0, 1, 2}, {0.1, 0.7, 0.3});
    EXPECT_EQ(format_plot(plot), format_plot(plot));
    EXPECT_THAT(format_plot(plot), Not(HasSubstr("href")));
    EXPECT_THAT(format_plot(plot), Not(HasSubstr("-0.00")));
}

TEST(Plot, refuses_what_cannot_be_drawn) {
    EXPECT_THAT(
        [] {
            format_plot(plot_of({0, 1}, {1}));
        },
        ThrowsMessage<Error>(HasSubstr("as many y as x in curve 'curve', found 1 and 2")));
    EXPECT_THAT([] { format_plot(plot_of({0}, {2e100})); }, ThrowsMessage<Error>(HasSubstr("found 2e+100")));
    EXPECT_THROW(format_plot({.width = 100}), Error);
    EXPECT_THROW(format_plot({.height = 20000}), Error);
}

}  // namespace
}  // namespace mien
