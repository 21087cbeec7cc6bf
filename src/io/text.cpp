// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <system_error>

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::string_view blanks = " \t\r\n\v\f\\";  // a backslash before the end of a line goes on with the line

// from_chars takes no plus sign, but some writers put one.
std::string_view without_plus(std::string_view word) {
    const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+';
    return plus ? word.substr(1) : word;
}

// What a number outside the range of its type stands for: from_chars does not say on which side it fell out.
double out_of_range(std::string_view word) {
    const std::size_t exponent = word.find_first_of("eE");
    const bool small = exponent == std::string_view::npos ? word.find_first_of("123456789") > word.find('.')
                                                          : word.substr(exponent + 1).starts_with('-');
    return small ? 0 : std::numeric_limits<double>::infinity();
}

template <class T>
void append(std::string& text, T number) {
    std::array<char, 64> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
    text.append(buffer.data(), end);
}

}  // namespace

std::optional<double> parse_double(std::string_view word) {
    word = without_plus(word);
    double number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (end != word.data() + word.size() || error == std::errc::invalid_argument) return std::nullopt;
    return error == std::errc::result_out_of_range ? out_of_range(word) : number;
}

std::optional<float> parse_float(std::string_view word) {
    const std::string_view digits = without_plus(word);
    float number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error == std::errc{} && end == digits.data() + digits.size()) return number;
    const std::optional<double> wide = parse_double(word);
    if (!wide) return std::nullopt;
    const bool fits = !(std::abs(*wide) > static_cast<double>(std::numeric_limits<float>::max()));
    return fits ? static_cast<float>(*wide) : std::numeric_limits<float>::infinity();
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
    word = without_plus(word);
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (end != word.data() + word.size() || error != std::errc{}) return std::nullopt;
    return number;
}

void append_number(std::string& text, double number) {
    append(text, number);
}
void append_number(std::string& text, float number) {
    append(text, number);
}

std::string shown(std::string_view found) {
    constexpr std::size_t longest = 40;
    if (found.empty()) return "nothing";
    std::string text = "'";
    for (const char c : found.substr(0, longest)) text += c >= ' ' && c <= '~' ? c : '?';
    return text + (found.size() > longest ? "...'" : "'");
}

std::string_view trimmed(std::string_view text) {
    const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    return text;
}

bool equal_but_case(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char c, char d) { return lower(c) == lower(d); });
}

void check_size(std::span<const std::byte> bytes, std::string_view format) {
    if (bytes.size() >= std::numeric_limits<std::uint32_t>::max())
        throw Error(fmt::format("{}: expected less than 4 GiB, found {} bytes", format, bytes.size()));
}

void check_text(std::span<const std::byte> bytes, std::string_view format) {
    check_size(bytes, format);
    const std::size_t nul = as_text(bytes).find('\0');
    if (nul != std::string_view::npos)
        throw Error(fmt::format("{} byte {}: expected text, found a NUL byte", format, nul));
}

Lines::Lines(std::string_view text, std::string_view format) : text_(text), format_(format) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (text_.starts_with(byte_order_mark)) text_.remove_prefix(byte_order_mark.size());
}

bool Lines::next() {
    begin_ = after_;
    return join_next();
}

bool Lines::next_filled() {
    while (next())
        if (!trimmed(line_).empty()) return true;
    return false;
}

bool Lines::join_next() {
    if (after_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', after_), text_.size());
    line_ = text_.substr(begin_, end - begin_);
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    after_ = end + 1;
    ++number_;
    return true;
}

void Lines::fail(std::string_view sentence) const {
    fail_at(number_, sentence);
}

void Lines::fail_at(std::size_t line_number, std::string_view sentence) const {
    throw Error(fmt::format("{} line {}: {}", format_, line_number, sentence));
}

std::string_view Words::next() {
    const std::size_t begin = std::min(text_.find_first_not_of(blanks, at_), text_.size());
    at_ = std::min(text_.find_first_of(blanks, begin), text_.size());
    return text_.substr(begin, at_ - begin);
}

void split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells) {
    cells.clear();
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(separator, begin), line.size());
        cells.push_back(trimmed(line.substr(begin, end - begin)));
        begin = end + 1;
    }
}

namespace {

// Reads a quoted cell from `at`, which stands behind its opening quote; a quote inside is doubled.
std::optional<std::string> quoted_cell(std::string_view line, std::size_t& at) {
    std::string cell;
    for (; at < line.size(); ++at) {
        if (line[at] != '"') {
            cell += line[at];
        } else if (at + 1 < line.size() && line[at + 1] == '"') {
            cell += line[at++];
        } else {
            at = std::min(line.find(',', at), line.size());
            return cell;
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<std::vector<std::string>> comma_cells(std::string_view line) {
    std::vector<std::string> cells;
    for (std::size_t at = 0; at <= line.size(); ++at) {
        const std::size_t first = std::min(line.find_first_not_of(" \t", at), line.size());
        if (first < line.size() && line[first] == '"') {
            at = first + 1;
            const std::optional<std::string> cell = quoted_cell(line, at);
            if (!cell) return std::nullopt;
            cells.emplace_back(trimmed(*cell));
        } else {
            const std::size_t end = std::min(line.find(',', at), line.size());
            cells.emplace_back(trimmed(line.substr(at, end - at)));
            at = end;
        }
    }
    return cells;
}

}  // namespace mien
