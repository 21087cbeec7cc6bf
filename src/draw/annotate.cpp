// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Each mark is drawn by cairo on a small transparent layer of its own, which is then laid over the picture: a picture
// keeps its colours apart from its alpha, cairo does not, and converting all of it for every mark would cost more than
// the marks. Letters are neither hinted nor snapped to pixels, so they look alike at every place.

#include "mien/draw/annotate.hpp"

#include <algorithm>
#include <array>
#include <cairo.h>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <numbers>
#include <vector>

#include "draw/blend.hpp"
#include "draw/legend.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr float farthest = 1e6F;

struct Free {
    void operator()(cairo_t* context) const { cairo_destroy(context); }
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_font_options_t* options) const { cairo_font_options_destroy(options); }
};

struct Box {
    double left = 0, top = 0, right = 0, bottom = 0;
};

Box around(double x, double y, double reach) {
    return {x - reach, y - reach, x + reach, y + reach};
}

bool overlap(const Box& a, const Box& b) {
    return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

bool is_near(Vec2f p) {
    return std::abs(p.x) <= farthest && std::abs(p.y) <= farthest;  // false for NaN
}

// A transparent sheet over the part of a picture that a box covers.
class Layer {
public:
    Layer(Picture& picture, const Box& box)
        : picture_(picture),
          left_(inside(std::floor(box.left), picture.width)),
          top_(inside(std::floor(box.top), picture.height)),
          width_(inside(std::ceil(box.right), picture.width) - left_),
          height_(inside(std::ceil(box.bottom), picture.height) - top_),
          surface_(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width_, height_)),
          context_(cairo_create(surface_.get())) {
        cairo_translate(context_.get(), -left_, -top_);
    }

    [[nodiscard]] cairo_t* context() const { return context_.get(); }

    void ink(const Colour& colour) const {
        cairo_set_source_rgba(context(), colour.r / 255.0, colour.g / 255.0, colour.b / 255.0, colour.a / 255.0);
    }

    void lay() const {
        cairo_surface_flush(surface_.get());
        const unsigned char* rows = cairo_image_surface_get_data(surface_.get());
        if (!rows) return;  // nothing inside the picture, or more than cairo's 32767 pixels
        const int stride = cairo_image_surface_get_stride(surface_.get());
        for (int y = 0; y < height_; ++y) {
            const auto* row = reinterpret_cast<const std::uint32_t*>(rows + static_cast<std::ptrdiff_t>(y) * stride);
            std::uint8_t* onto = &picture_.rgba[4 * (std::size_t{picture_.width} * (top_ + y) + left_)];
            for (int x = 0; x < width_; ++x) lay_over(onto + std::ptrdiff_t{4} * x, parted(row[x]));
        }
    }

private:
    static int inside(double edge, std::uint32_t size) {
        return static_cast<int>(std::clamp(edge, 0.0, static_cast<double>(size)));
    }

    // Cairo's pixel, alpha first and multiplied into the rest.
    static Colour parted(std::uint32_t argb) {
        const std::uint32_t a = argb >> 24;
        if (a == 0) return {0, 0, 0, 0};
        const auto channel = [&](int shift) {
            return static_cast<std::uint8_t>(std::min(255U, (((argb >> shift) & 255U) * 255U + a / 2) / a));
        };
        return {channel(16), channel(8), channel(0), static_cast<std::uint8_t>(a)};
    }

    Picture& picture_;
    int left_, top_, width_, height_;
    std::unique_ptr<cairo_surface_t, Free> surface_;
    std::unique_ptr<cairo_t, Free> context_;
};

void set_font(cairo_t* context, const LabelStyle& style) {
    const std::unique_ptr<cairo_font_options_t, Free> options(cairo_font_options_create());
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(context, options.get());
    cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context, style.size);
}

double share_at(Align align) {
    return align == Align::left ? 0 : align == Align::middle ? 0.5 : 1;
}

constexpr double capitals = 0.729;   // the height of DejaVu's capitals over the em
constexpr double halo_width = 0.26;  // over the em, half of it outside the letters

// What a line of text covers: ascenders, descenders and accents with some air.
Box label_box(Vec2f at, double width, const LabelStyle& style) {
    const double left = at.x - share_at(style.align) * width, half = 0.62 * style.size, air = 0.15 * style.size;
    return {left - air, at.y - half, left + width + air, at.y + half};
}

// Cairo refuses what is no UTF-8 or holds a NUL; the letters outside ASCII are then lost.
std::string as_utf8(std::string_view text) {
    std::string result(text);
    std::replace(result.begin(), result.end(), '\0', '?');
    Picture none;
    const Layer probe(none, {});
    set_font(probe.context(), {});
    cairo_text_extents_t extents;
    cairo_text_extents(probe.context(), result.c_str(), &extents);
    if (cairo_status(probe.context()) == CAIRO_STATUS_SUCCESS) return result;
    std::replace_if(
        result.begin(), result.end(), [](char c) { return static_cast<unsigned char>(c) > 127; }, '?');
    return result;
}

}  // namespace

double label_width(std::string_view text, const LabelStyle& style) {
    Picture none;
    const Layer layer(none, {});
    set_font(layer.context(), style);
    cairo_text_extents_t extents;
    cairo_text_extents(layer.context(), as_utf8(text).c_str(), &extents);
    return extents.x_advance;
}

void draw_label(Picture& picture, Vec2f at, std::string_view text, const LabelStyle& style) {
    if (!is_near(at) || text.empty()) return;
    const double width = label_width(text, style);
    Box box = label_box(at, width, style);
    const double margin = 0.4 * style.size;
    const Layer layer(picture, {box.left - margin, box.top - margin, box.right + margin, box.bottom + margin});
    cairo_t* context = layer.context();
    set_font(context, style);
    cairo_move_to(context, at.x - share_at(style.align) * width, at.y + capitals / 2 * style.size);
    cairo_text_path(context, as_utf8(text).c_str());
    if (style.halo.a != 0) {
        layer.ink(style.halo);
        cairo_set_line_width(context, halo_width * style.size);
        cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
        cairo_stroke_preserve(context);
    }
    layer.ink(style.ink);
    cairo_fill(context);
    layer.lay();
}

void draw_line(Picture& picture, Vec2f from, Vec2f to, const LineStyle& style) {
    if (!is_near(from) || !is_near(to)) return;
    const double reach = style.width / 2 + 1;
    const Layer layer(picture, {std::min(from.x, to.x) - reach, std::min(from.y, to.y) - reach,
                                std::max(from.x, to.x) + reach, std::max(from.y, to.y) + reach});
    layer.ink(style.ink);
    cairo_set_line_width(layer.context(), style.width);
    cairo_set_line_cap(layer.context(), CAIRO_LINE_CAP_ROUND);
    cairo_move_to(layer.context(), from.x, from.y);
    cairo_line_to(layer.context(), to.x, to.y);
    cairo_stroke(layer.context());
    layer.lay();
}

void draw_marker(Picture& picture, Vec2f at, const MarkerStyle& style) {
    if (!is_near(at)) return;
    const Layer layer(picture, around(at.x, at.y, style.radius + 1));
    const auto disc = [&](double radius, const Colour& colour) {
        layer.ink(colour);
        cairo_new_path(layer.context());
        cairo_arc(layer.context(), at.x, at.y, radius, 0, 2 * std::numbers::pi);
        cairo_fill(layer.context());
    };
    disc(style.radius, style.rim);
    disc(style.rim.a == 0 ? style.radius : style.radius * 2 / 3, style.fill);
    layer.lay();
}

namespace {

// The eight sides of a dot where its name may stand, the best first.
struct Side {
    double x, y;
    Align align;
};
constexpr std::array<Side, 8> sides = {{{1, 0, Align::left},
                                        {-1, 0, Align::right},
                                        {0, -1, Align::middle},
                                        {0, 1, Align::middle},
                                        {0.7, -0.8, Align::left},
                                        {0.7, 0.8, Align::left},
                                        {-0.7, -0.8, Align::right},
                                        {-0.7, 0.8, Align::right}}};

struct Placed {
    Vec2f at;
    Align align = Align::left;
    Box box;
};

Placed place_on(const Side& side, Vec2f point, double width, const PointsStyle& style) {
    const double reach = style.marker.radius + 0.2 * style.label.size;
    const double rise = side.align == Align::middle ? reach + 0.45 * style.label.size : reach;
    Placed placed;
    placed.at = {static_cast<float>(point.x + side.x * reach), static_cast<float>(point.y + side.y * rise)};
    placed.align = side.align;
    LabelStyle label = style.label;
    label.align = side.align;
    placed.box = label_box(placed.at, width, label);
    const double slack = 0.2 * style.label.size;  // the box leaves room for accents that ids do not have
    placed.box.top += slack;
    placed.box.bottom -= slack;
    return placed;
}

}  // namespace

void draw_points(Picture& picture, std::span<const Vec2f> places, std::span<const std::string> names,
                 const PointsStyle& style) {
    if (places.size() != names.size())
        throw Error(fmt::format("points to draw: expected a name for each of {} places, found {}", places.size(),
                                names.size()));
    std::vector<Box> taken;
    for (const Vec2f& place : places) {
        draw_marker(picture, place, style.marker);
        taken.push_back(around(place.x, place.y, style.marker.radius));
    }
    for (std::size_t p = 0; p < places.size(); ++p) {
        const double width = label_width(names[p], style.label);
        const auto is_free = [&](const Side& side) {
            const Box box = place_on(side, places[p], width, style).box;
            return std::none_of(taken.begin(), taken.end(), [&](const Box& other) { return overlap(box, other); });
        };
        const auto* const side = std::find_if(sides.begin(), sides.end(), is_free);
        const Placed placed = place_on(side == sides.end() ? sides[0] : *side, places[p], width, style);
        taken.push_back(placed.box);
        LabelStyle label = style.label;
        label.align = placed.align;
        draw_label(picture, placed.at, names[p], label);
    }
}

LegendEnds ends_of(const Legend& legend) {
    return {fmt::format("{:.3g}", legend.low),
            fmt::format("{:.3g}{}{}", legend.high, legend.unit.empty() ? "" : " ", legend.unit)};
}

void draw_legend(Picture& picture, Vec2f at, const Legend& legend, const LabelStyle& style) {
    if (!is_near(at)) return;
    const auto left = std::lround(at.x), top = std::lround(at.y);
    const auto width = std::max(2L, std::lround(legend.width)), height = std::max(1L, std::lround(legend.height));
    for (long x = std::max(0L, left); x < std::min<long>(picture.width, left + width); ++x) {
        const Colour colour = colour_at(legend.scale, static_cast<double>(x - left) / static_cast<double>(width - 1));
        for (long y = std::max(0L, top); y < std::min<long>(picture.height, top + height); ++y)
            lay_over(&picture.rgba[4 * (std::size_t{picture.width} * y + x)], colour);
    }
    const auto middle = static_cast<float>(static_cast<double>(top) + static_cast<double>(height) / 2);
    const auto gap = static_cast<float>(legend_gap * style.size);
    LabelStyle before = style, behind = style;
    before.align = Align::right;
    behind.align = Align::left;
    draw_label(picture, {static_cast<float>(left) - gap, middle}, ends_of(legend).before, before);
    draw_label(picture, {static_cast<float>(left + width) + gap, middle}, ends_of(legend).behind, behind);
}

}  // namespace mien
