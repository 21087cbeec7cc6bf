// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Every sheet is a grid; a contact sheet is one without names. All text is broken into lines first, so that every
// height is known before anything is drawn and nothing ever lies over a picture.

#include "mien/draw/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

#include "draw/blend.hpp"
#include "draw/legend.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::size_t largest_side = 32767;
constexpr double line_height = 1.4;  // over the size of the letters

using Lines = std::vector<std::string>;

bool starts_letter(char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;  // not inside a letter of UTF-8
}

// Whether a line may end before byte `at`: at a blank, behind a sign that joins words, inside "jawOpen".
bool may_break(std::string_view text, std::size_t at) {
    const char last = text[at - 1], next = text[at];
    const bool hump = last >= 'a' && last <= 'z' && next >= 'A' && next <= 'Z';
    return hump || next == ' ' || std::string_view("+/_-,").find(last) != std::string_view::npos;
}

// How many bytes of the text go on a line: up to the last place where it may break, or, where there is none, as many
// letters as fit. One letter always does.
std::size_t bytes_that_fit(std::string_view text, double width, const LabelStyle& style) {
    if (label_width(text, style) <= width) return text.size();
    std::size_t letters = 0, words = 0;
    for (std::size_t end = 1; end < text.size(); ++end) {
        if (!starts_letter(text[end])) continue;
        if (letters > 0 && label_width(text.substr(0, end), style) > width) break;
        letters = end;
        if (may_break(text, end)) words = end;
    }
    if (words > 0) return words;
    return letters > 0 ? letters : text.size();
}

Lines broken(std::string_view text, double width, const LabelStyle& style) {
    Lines lines;
    while (!text.empty()) {
        const std::string_view paragraph = text.substr(0, text.find('\n'));
        std::size_t used = bytes_that_fit(paragraph, width, style);
        lines.emplace_back(text.substr(0, used));
        while (used < text.size() && text[used] == ' ') ++used;
        if (used < text.size() && text[used] == '\n') ++used;
        text.remove_prefix(used);
    }
    return lines;
}

std::size_t pixels(double length) {
    return static_cast<std::size_t>(std::ceil(length));
}

struct Block {
    std::vector<Lines> texts;  // one for each cell, row or column; may be empty
    LabelStyle style;

    [[nodiscard]] std::size_t step() const { return pixels(line_height * style.size); }
    // Room for the texts from `first` on.
    [[nodiscard]] std::size_t height(std::size_t first, std::size_t count) const {
        std::size_t lines = 0;
        for (std::size_t t = first; t < std::min(first + count, texts.size()); ++t)
            lines = std::max(lines, texts[t].size());
        return lines * step();
    }
};

Block block(std::span<const std::string> texts, double width, const LabelStyle& style) {
    Block result{{}, style};
    for (const std::string& text : texts) result.texts.push_back(broken(text, width, style));
    return result;
}

// Everything that is known about a sheet before it is drawn; lengths in pixels.
struct Layout {
    std::size_t columns = 1, rows = 1;
    std::size_t cell_width = 0, cell_height = 0;
    std::size_t names_width = 0;  // of the names of rows, gap included
    Block title, note, heads, names, captions;
    std::vector<std::size_t> tops;  // of each row of pictures, then the end of the last caption
    std::size_t width = 0, height = 0;

    [[nodiscard]] std::size_t left(std::size_t column, const SheetOptions& options) const {
        return options.margin + names_width + column * (cell_width + options.gap);
    }
};

void check(std::span<const Picture> pictures, std::size_t captions) {
    if (pictures.empty()) throw Error("sheet: expected at least one picture, found none");
    if (captions != 0 && captions != pictures.size())
        throw Error(fmt::format("sheet: expected a caption for each of {} pictures, or none, found {}", pictures.size(),
                                captions));
    for (std::size_t p = 0; p < pictures.size(); ++p) {
        const Picture& picture = pictures[p];
        const std::size_t bytes = std::size_t{4} * picture.width * picture.height;
        if (bytes == 0 || picture.rgba.size() != bytes)
            throw Error(fmt::format("sheet: expected {} x {} pixels of picture {} in {} bytes, found {}", picture.width,
                                    picture.height, p + 1, bytes, picture.rgba.size()));
    }
}

void measure_cells(std::span<const Picture> pictures, Layout& layout) {
    for (const Picture& picture : pictures) {
        layout.cell_width = std::max<std::size_t>(layout.cell_width, picture.width);
        layout.cell_height = std::max<std::size_t>(layout.cell_height, picture.height);
    }
}

// The number of columns that brings the pictures nearest to 3:2, an empty cell being as bad as a shape that is off by
// its share.
std::size_t chosen_columns(std::size_t count, const Layout& layout) {
    const auto distance = [&](std::size_t columns) {
        const std::size_t rows = (count + columns - 1) / columns;
        const auto width = static_cast<double>(columns * layout.cell_width);
        const double empty = static_cast<double>(rows * columns - count) / static_cast<double>(count);
        return std::abs(std::log(width / static_cast<double>(rows * layout.cell_height) / 1.5)) + empty;
    };
    std::size_t best = 1;
    for (std::size_t columns = 2; columns <= count; ++columns)
        if (distance(columns) < distance(best)) best = columns;
    return best;
}

LabelStyle text_style(const SheetOptions& options) {
    return {.size = options.text_size, .align = Align::middle, .ink = options.ink};
}

LabelStyle quiet(LabelStyle style) {
    style.ink.a = static_cast<std::uint8_t>(style.ink.a * 2 / 3);
    return style;
}

void break_texts(const GridNames& names, const SheetOptions& options, Layout& layout) {
    const LabelStyle style = text_style(options);
    LabelStyle title = style, strong = style, names_style = style;
    title.size = 1.5 * style.size;
    title.bold = strong.bold = true;
    title.align = Align::left;
    names_style.align = Align::right;
    const auto cell = static_cast<double>(layout.cell_width);
    layout.captions = block(names.cells, cell, names.columns.empty() ? style : quiet(style));
    layout.heads = block(names.columns, cell, style);
    const double names_room = std::max(0.75 * cell, 9 * style.size);
    layout.names = block(names.rows, names_room, names_style);
    double widest = 0;
    for (const Lines& lines : layout.names.texts)
        for (const std::string& line : lines) widest = std::max(widest, label_width(line, names_style));
    layout.names_width = widest > 0 ? pixels(widest) + options.gap : 0;
    layout.width = layout.left(layout.columns, options) - options.gap + options.margin;
    const auto inner = static_cast<double>(layout.width - std::size_t{2} * options.margin);
    LabelStyle note = quiet(style);
    note.align = Align::left;
    layout.title = block(std::span(&options.title, 1), inner, title);
    layout.note = block(std::span(&options.note, 1), inner, note);
}

std::size_t legend_height(const SheetOptions& options) {
    return options.legend ? options.gap + pixels(std::max(options.legend->height, line_height * options.text_size)) : 0;
}

void stack(const SheetOptions& options, Layout& layout) {
    std::size_t y = options.margin + layout.title.height(0, 1) + layout.note.height(0, 1);
    if (y > options.margin) y += options.gap;
    y += layout.heads.height(0, layout.columns);
    for (std::size_t row = 0; row < layout.rows; ++row) {
        if (row > 0) y += options.gap;
        layout.tops.push_back(y);
        y += std::max(layout.cell_height + layout.captions.height(row * layout.columns, layout.columns),
                      layout.names.height(row, 1));
    }
    layout.tops.push_back(y);
    layout.height = y + legend_height(options) + options.margin;
    if (layout.width > largest_side || layout.height > largest_side)
        throw Error(fmt::format("sheet: expected at most {} pixels in width and height, found {} x {}", largest_side,
                                layout.width, layout.height));
}

Picture blank(const Layout& layout, const Colour& paper) {
    Picture sheet{static_cast<std::uint32_t>(layout.width), static_cast<std::uint32_t>(layout.height), {}};
    sheet.rgba.reserve(4 * layout.width * layout.height);
    for (std::size_t p = 0; p < layout.width * layout.height; ++p)
        sheet.rgba.insert(sheet.rgba.end(), {paper.r, paper.g, paper.b, paper.a});
    return sheet;
}

void lay_picture(Picture& sheet, const Picture& picture, std::size_t left, std::size_t top) {
    for (std::size_t y = 0; y < picture.height; ++y) {
        std::uint8_t* onto = &sheet.rgba[4 * (sheet.width * (top + y) + left)];
        const std::uint8_t* from = &picture.rgba[std::size_t{4} * picture.width * y];
        for (std::size_t x = 0; x < picture.width; ++x, onto += 4, from += 4)
            lay_over(onto, {from[0], from[1], from[2], from[3]});
    }
}

// Writes lines from `top` down; `x` is the end or the middle that their style aligns them to.
void write_lines(Picture& sheet, const Block& block, std::size_t which, double x, std::size_t top) {
    if (which >= block.texts.size()) return;
    double y = static_cast<double>(top) + static_cast<double>(block.step()) / 2;
    for (const std::string& line : block.texts[which]) {
        draw_label(sheet, {static_cast<float>(x), static_cast<float>(y)}, line, block.style);
        y += static_cast<double>(block.step());
    }
}

void write_names(Picture& sheet, const Layout& layout, const SheetOptions& options) {
    const std::size_t under_title = options.margin + layout.title.height(0, 1);
    write_lines(sheet, layout.title, 0, options.margin, options.margin);
    write_lines(sheet, layout.note, 0, options.margin, under_title);
    for (std::size_t column = 0; column < layout.columns; ++column) {
        const double middle =
            static_cast<double>(layout.left(column, options)) + static_cast<double>(layout.cell_width) / 2;
        write_lines(sheet, layout.heads, column, middle, layout.tops[0] - layout.heads.height(column, 1));
    }
    for (std::size_t row = 0; row < layout.rows; ++row) {
        const std::size_t free = layout.cell_height - std::min(layout.cell_height, layout.names.height(row, 1));
        write_lines(sheet, layout.names, row, static_cast<double>(layout.left(0, options) - options.gap),
                    layout.tops[row] + free / 2);
    }
}

void lay_cells(Picture& sheet, std::span<const Picture> pictures, const Layout& layout, const SheetOptions& options) {
    for (std::size_t p = 0; p < pictures.size(); ++p) {
        const std::size_t left = layout.left(p % layout.columns, options), top = layout.tops[p / layout.columns];
        lay_picture(sheet, pictures[p], left + (layout.cell_width - pictures[p].width) / 2,
                    top + (layout.cell_height - pictures[p].height) / 2);
        write_lines(sheet, layout.captions, p, static_cast<double>(left) + static_cast<double>(layout.cell_width) / 2,
                    top + layout.cell_height);
    }
}

// The bar with what is written at its ends is centred as a whole.
void lay_legend(Picture& sheet, const Layout& layout, const SheetOptions& options) {
    if (!options.legend) return;
    const Legend& legend = *options.legend;
    const LabelStyle style = quiet(text_style(options));
    const double lean = label_width(ends_of(legend).before, style) - label_width(ends_of(legend).behind, style);
    const double left = (static_cast<double>(layout.width) - legend.width + lean) / 2;
    const double room = static_cast<double>(legend_height(options) - options.gap);
    const double top = static_cast<double>(layout.tops.back() + options.gap) + (room - legend.height) / 2;
    draw_legend(sheet, {static_cast<float>(left), static_cast<float>(top)}, legend, style);
}

Picture make_sheet(std::span<const Picture> pictures, const GridNames& names, const SheetOptions& options,
                   std::size_t columns) {
    check(pictures, names.cells.size());
    Layout layout;
    measure_cells(pictures, layout);
    layout.columns = columns != 0 ? columns : chosen_columns(pictures.size(), layout);
    layout.rows = (pictures.size() + layout.columns - 1) / layout.columns;
    break_texts(names, options, layout);
    stack(options, layout);
    Picture sheet = blank(layout, options.paper);
    lay_cells(sheet, pictures, layout, options);
    write_names(sheet, layout, options);
    lay_legend(sheet, layout, options);
    return sheet;
}

}  // namespace

Picture contact_sheet(std::span<const Picture> pictures, std::span<const std::string> captions,
                      const SheetOptions& options) {
    return make_sheet(pictures, {{}, {}, {captions.begin(), captions.end()}}, options, options.columns);
}

Picture beside(const Picture& left, const Picture& right, std::span<const std::string> captions,
               const SheetOptions& options) {
    SheetOptions two = options;
    two.columns = 2;
    return contact_sheet(std::vector<Picture>{left, right}, captions, two);
}

Picture grid(std::span<const Picture> pictures, const GridNames& names, const SheetOptions& options) {
    if (names.columns.empty() || pictures.size() != names.rows.size() * names.columns.size())
        throw Error(fmt::format("sheet: expected a picture for each of {} rows by {} columns, found {}",
                                names.rows.size(), names.columns.size(), pictures.size()));
    return make_sheet(pictures, names, options, names.columns.size());
}

}  // namespace mien
