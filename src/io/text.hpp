// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A small checked scanner that every text format here reads through: lines that know their number, tokens between
// blanks, cells between separators, and numbers by from_chars, which no locale reaches.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mien {

/// The bytes of a file seen as text; nothing is copied or checked.
inline std::string_view as_text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Text seen as the bytes of a file.
inline std::span<const std::byte> as_bytes(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

/// The whole of `word` as a number ("nan" and "inf" are numbers, too large is infinite, too small is zero), or nothing
/// when anything else is in it.
std::optional<double> parse_double(std::string_view word);
std::optional<float> parse_float(std::string_view word);

/// The whole of `word` as an integer, or nothing.
std::optional<std::int64_t> parse_integer(std::string_view word);

/// The shortest text that reads back as the same number.
void append_number(std::string& text, double number);
void append_number(std::string& text, float number);

/// What was found, for a sentence: quoted, at most 40 bytes of it, unprintable bytes as '?'.
std::string shown(std::string_view found);

/// Without the blanks at both ends.
std::string_view trimmed(std::string_view text);

/// Whether two texts are equal but for the case of ASCII letters.
bool equal_but_case(std::string_view a, std::string_view b);

/// Throws Error if there are so many bytes that 32-bit indices could run over, or a NUL byte where text is expected.
void check_size(std::span<const std::byte> bytes, std::string_view format);
void check_text(std::span<const std::byte> bytes, std::string_view format);

/// Goes through a text line by line; the end of a line is LF, with or without a CR before it. A byte order mark at the
/// beginning is skipped.
class Lines {
public:
    Lines(std::string_view text, std::string_view format);

    /// Goes to the next line; false at the end of the text.
    bool next();
    /// Goes to the next line that is not blank.
    bool next_filled();
    /// Takes one more line into the present one; false at the end of the text.
    bool join_next();

    [[nodiscard]] std::string_view line() const { return line_; }
    [[nodiscard]] std::size_t number() const { return number_; }

    /// Throws Error: "obj line 12: expected ..., found ...".
    [[noreturn]] void fail(std::string_view sentence) const;
    [[noreturn]] void fail_at(std::size_t line_number, std::string_view sentence) const;

private:
    std::string_view text_, format_, line_;
    std::size_t begin_ = 0, after_ = 0, number_ = 0;
};

/// Goes through the words of a text: what stands between blanks, ends of lines included.
class Words {
public:
    explicit Words(std::string_view text) : text_(text) {}

    /// The next word; empty at the end.
    std::string_view next();
    /// What has not been read yet.
    [[nodiscard]] std::string_view rest() const { return text_.substr(at_); }
    [[nodiscard]] std::size_t position() const { return at_; }

private:
    std::string_view text_;
    std::size_t at_ = 0;
};

/// The cells of a line between separators, trimmed, into `cells`.
void split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells);

/// The cells of a line of comma-separated values, trimmed, quotes taken off. Nothing when a quote is not closed.
std::optional<std::vector<std::string>> comma_cells(std::string_view line);

}  // namespace mien
