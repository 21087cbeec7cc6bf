// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// FAP text files as the MPEG-4 reference software, Greta, Xface and VReng write and read them. Two things make it
// quick: a mask that is written exactly as the one before is known by its bytes, and whole numbers are read digit by
// digit. Anything else (a fraction, an exponent, many digits) takes the general way.

#include "mien/io/fap_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// A place in the text. The number of its line is counted only when it is asked for.
class Cursor {
public:
    explicit Cursor(std::string_view text) : begin_(text.data()), at_(text.data()), end_(text.data() + text.size()) {}

    // Goes over blanks, ends of lines and comments to the next word; false at the end of the text.
    bool to_word() {
        for (; at_ != end_; ++at_) {
            if (*at_ == '#')
                at_ = std::find(at_, end_, '\n');
            else if (!is_blank(*at_) && *at_ != '\n')
                return true;
            if (at_ == end_) return false;
        }
        return false;
    }

    // Goes over blanks; false at the end of the line.
    bool to_word_on_line() {
        while (at_ != end_ && is_blank(*at_)) ++at_;
        return at_ != end_ && *at_ != '\n' && *at_ != '#';
    }

    std::string_view line() {
        const char* const from = at_;
        at_ = std::find(at_, end_, '\n');
        return {from, at_};
    }

    std::string_view word() {
        const char* const from = at_;
        while (at_ != end_ && !is_blank(*at_) && *at_ != '\n') ++at_;
        return {from, at_};
    }

    // Goes over `text` if it stands here.
    bool skip(std::string_view text) {
        if (!std::string_view(at_, end_).starts_with(text)) return false;
        at_ += text.size();
        return true;
    }

    // The whole number of at most 9 digits that stands here as a word, or nothing, and the place is kept.
    std::optional<std::int32_t> small_number() {
        const char* c = at_;
        const bool negative = c != end_ && *c == '-';
        if (negative) ++c;
        const char* const first = c;
        std::int32_t number = 0;
        for (; c != end_ && is_digit(*c) && c - first < 9; ++c) number = 10 * number + (*c - '0');
        if (c == first || (c != end_ && !is_blank(*c) && *c != '\n')) return std::nullopt;
        at_ = c;
        return negative ? -number : number;
    }

    [[nodiscard]] const char* place() const { return at_; }

    [[noreturn]] void fail(std::string_view sentence) const {
        const auto line = 1 + std::count(begin_, at_, '\n');
        throw Error(fmt::format("fap line {}: {}", line, sentence));
    }

private:
    const char *begin_, *at_, *end_;
};

std::string_view last_word(std::string_view& line) {
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    std::size_t begin = line.size();
    while (begin > 0 && !is_blank(line[begin - 1])) --begin;
    const std::string_view word = line.substr(begin);
    line.remove_suffix(word.size());
    return word;
}

// A name may hold any sign but blanks in a row.
std::string joined_words(std::string_view text) {
    std::string joined;
    for (const char c : text) {
        const bool blank = is_blank(c);
        if (!blank && !joined.empty() && joined.back() == '\0') joined.back() = ' ';
        if (!blank)
            joined += c;
        else if (!joined.empty() && joined.back() != '\0')
            joined += '\0';
    }
    if (joined.ends_with('\0')) joined.pop_back();
    return joined;
}

struct Header {
    FapStream stream;
    std::uint64_t frames = 0;
};

Header read_header(Cursor& cursor) {
    do {
        if (!cursor.to_word()) throw Error("fap: expected 'version name fps frames', found an empty file");
    } while (cursor.skip("\xef\xbb\xbf"));  // a byte order mark
    Header header;
    header.stream.version = cursor.word();
    const Cursor before = cursor;
    std::string_view line = cursor.line();
    const std::string_view frames = last_word(line), rate = last_word(line);
    const std::optional<double> fps = parse_double(rate);
    if (!fps || !std::isfinite(*fps) || *fps <= 0)
        before.fail(fmt::format("expected 'version name fps frames' with fps above 0, found {}", shown(rate)));
    const std::optional<std::int64_t> count = parse_integer(frames);
    if (!count || *count < 0) before.fail(fmt::format("expected a number of frames, found {}", shown(frames)));
    header.stream.rate = *fps;
    header.stream.name = joined_words(line);
    header.frames = static_cast<std::uint64_t>(*count);
    return header;
}

// What a mask says: which parameters have values, in the order of the values, and how many values follow for columns
// that stand for no parameter.
struct Columns {
    std::string_view text;  // as written, up to the frame number
    FapMask mask;
    std::array<std::uint8_t, fap_count> sent{};
    std::size_t sent_count = 0, spare = 0;
};

bool read_flag(Cursor& cursor) {
    const Cursor before = cursor;
    const std::string_view word = cursor.word();
    if (word != "0" && word != "1") before.fail(fmt::format("expected 0 or 1 in the mask, found {}", shown(word)));
    return word == "1";
}

Columns read_columns(Cursor& cursor) {
    Columns columns;
    const char* const begin = cursor.place();
    for (std::size_t i = 0; i < fap_count; ++i) {
        if (!cursor.to_word()) cursor.fail(fmt::format("expected 68 mask columns, found {}", i));
        columns.mask[i] = read_flag(cursor);
        // 1 and 2 are read apart from the others.
        if (columns.mask[i] && i >= 2) columns.sent[columns.sent_count++] = static_cast<std::uint8_t>(i);
    }
    while (cursor.to_word_on_line()) columns.spare += read_flag(cursor) ? 1U : 0U;
    columns.text = {begin, cursor.place()};
    return columns;
}

std::int32_t read_general_number(Cursor& cursor, std::string_view what) {
    const Cursor before = cursor;
    const std::string_view word = cursor.word();
    const std::optional<double> number = parse_double(word);
    if (!number) before.fail(fmt::format("expected {}, found {}", what, shown(word)));
    const double rounded = std::round(*number);
    if (!(std::abs(rounded) <= std::numeric_limits<std::int32_t>::max()))
        before.fail(fmt::format("expected {} within 32 bits, found {}", what, shown(word)));
    return static_cast<std::int32_t>(rounded);
}

inline std::int32_t read_value(Cursor& cursor, std::string_view what) {
    if (!cursor.to_word()) cursor.fail(fmt::format("expected {}, found the end of the file", what));
    const std::optional<std::int32_t> number = cursor.small_number();
    return number ? *number : read_general_number(cursor, what);
}

std::uint8_t read_choice(Cursor& cursor, std::string_view what, int most) {
    const std::int32_t number = read_value(cursor, what);
    if (number < 0 || number > most) cursor.fail(fmt::format("expected {} from 0 to {}, found {}", what, most, number));
    return static_cast<std::uint8_t>(number);
}

Viseme read_viseme(Cursor& cursor, bool single) {
    Viseme viseme;
    viseme.select1 = read_choice(cursor, "viseme_select1", 14);
    viseme.blend = 63;
    if (single) return viseme;
    viseme.select2 = read_choice(cursor, "viseme_select2", 14);
    viseme.blend = read_choice(cursor, "viseme_blend", 63);
    viseme.define = read_choice(cursor, "viseme_def", 1) == 1;
    return viseme;
}

Expression read_expression(Cursor& cursor, bool single) {
    Expression expression;
    expression.select1 = read_choice(cursor, "expression_select1", 6);
    expression.intensity1 = 63;
    if (single) return expression;
    expression.intensity1 = read_choice(cursor, "expression_intensity1", 63);
    expression.select2 = read_choice(cursor, "expression_select2", 6);
    expression.intensity2 = read_choice(cursor, "expression_intensity2", 63);
    expression.init_face = read_choice(cursor, "init_face", 1) == 1;
    expression.define = read_choice(cursor, "expression_def", 1) == 1;
    return expression;
}

std::uint32_t read_frame_number(Cursor& cursor, const std::vector<FapFrame>& frames) {
    const std::int32_t number = read_value(cursor, "a frame number");
    const std::int64_t least = frames.empty() ? 0 : std::int64_t{frames.back().number} + 1;
    if (number < least) cursor.fail(fmt::format("expected a frame number from {}, found {}", least, number));
    return static_cast<std::uint32_t>(number);
}

void read_values(Cursor& cursor, const Columns& columns, const FapTextOptions& options, FapFrame& frame) {
    frame.mask = columns.mask;
    if (frame.mask[0]) frame.viseme = read_viseme(cursor, options.single_numbers);
    if (frame.mask[1]) frame.expression = read_expression(cursor, options.single_numbers);
    for (std::size_t k = 0; k < columns.sent_count; ++k)
        frame.value[columns.sent[k]] = read_value(cursor, "the value of a parameter");
    for (std::size_t k = 0; k < columns.spare; ++k) read_value(cursor, "the value of a spare column");
    if (cursor.to_word_on_line())
        cursor.fail(fmt::format("expected as many values as the mask has 1s, found {} behind them",
                                shown(Cursor(cursor).word())));
}

}  // namespace

FapStream parse_fap_text(std::span<const std::byte> bytes, const FapTextOptions& options) {
    check_text(bytes, "fap");
    const std::string_view text = as_text(bytes);
    Cursor cursor(text);
    auto [stream, promised] = read_header(cursor);
    constexpr std::size_t shortest_frame = 2 * fap_count + 1;
    stream.frames.reserve(static_cast<std::size_t>(std::min<std::uint64_t>(promised, text.size() / shortest_frame)));

    Columns columns;
    while (cursor.to_word()) {
        // The same bytes up to the end of a line say the same: behind them no column can follow.
        const Cursor before = cursor;
        if (columns.text.empty() || !cursor.skip(columns.text) || cursor.to_word_on_line()) {
            cursor = before;
            columns = read_columns(cursor);
        }
        const std::uint32_t number = read_frame_number(cursor, stream.frames);
        FapFrame& frame = stream.frames.emplace_back();
        frame.number = number;
        read_values(cursor, columns, options, frame);
    }
    if (stream.frames.empty()) throw Error("fap: expected at least one frame, found none");
    return std::move(stream);
}

namespace {

void check_header(const FapStream& stream) {
    const auto word_in_line = [](std::string_view text) {
        return std::none_of(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\0'; });
    };
    const bool one_word = std::none_of(stream.version.begin(), stream.version.end(), is_blank);
    if (stream.version.empty() || stream.version[0] == '#' || !one_word || !word_in_line(stream.version))
        throw Error(fmt::format("fap: expected a version of one word, found {}", shown(stream.version)));
    if (!word_in_line(stream.name)) throw Error("fap: expected a name on one line, found " + shown(stream.name));
    if (!std::isfinite(stream.rate) || stream.rate <= 0)
        throw Error(fmt::format("fap: expected frames per second above 0, found {}", stream.rate));
}

void append_integer(std::string& text, std::int64_t number) {
    std::array<char, 24> buffer;
    text.append(buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr);
}

void append_value(std::string& text, std::int64_t number) {
    text += ' ';
    append_integer(text, number);
}

std::string mask_line(const FapMask& mask) {
    std::string line;
    for (std::size_t i = 0; i < fap_count; ++i) {
        if (i > 0) line += ' ';
        line += mask[i] ? '1' : '0';
    }
    return line + '\n';
}

void append_frame(std::string& text, const FapFrame& frame) {
    append_integer(text, frame.number);
    const Viseme& v = frame.viseme;
    if (frame.mask[0])
        for (const int part : {int{v.select1}, int{v.select2}, int{v.blend}, int{v.define}}) append_value(text, part);
    const Expression& e = frame.expression;
    if (frame.mask[1])
        for (const int part :
             {int{e.select1}, int{e.intensity1}, int{e.select2}, int{e.intensity2}, int{e.init_face}, int{e.define}})
            append_value(text, part);
    for (std::size_t i = 2; i < fap_count; ++i)
        if (frame.mask[i]) append_value(text, frame.value[i]);
    text += '\n';
}

}  // namespace

std::string format_fap_text(const FapStream& stream) {
    check_header(stream);
    std::string text = stream.version + ' ' + joined_words(stream.name) + ' ';
    append_number(text, stream.rate);
    append_value(text, static_cast<std::int64_t>(stream.frames.size()));
    text += '\n';
    std::string line;
    const FapMask* last = nullptr;
    for (const FapFrame& frame : stream.frames) {
        if (last == nullptr || *last != frame.mask) line = mask_line(frame.mask);
        last = &frame.mask;
        text += line;
        append_frame(text, frame);
    }
    return text;
}

}  // namespace mien
