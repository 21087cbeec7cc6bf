// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/bifs_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <unordered_map>

#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::size_t most_depth = 64;

enum class Kind { end, open, close, open_list, close_list, string, word };

struct Token {
    Kind kind = Kind::end;
    std::string_view text;
    std::size_t line = 0;
};

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',' || c == '\f' || c == '\v';
}

bool ends_word(char c) {
    return is_blank(c) || c == '{' || c == '}' || c == '[' || c == ']' || c == '"' || c == '#';
}

// Goes through the text token by token, with one to look ahead.
class Tokens {
public:
    explicit Tokens(std::string_view text) : text_(text) { ahead_ = scan(); }

    [[nodiscard]] const Token& peek() const { return ahead_; }
    Token next() {
        const Token token = ahead_;
        ahead_ = scan();
        return token;
    }

private:
    void skip_blanks() {
        for (; at_ < text_.size(); ++at_) {
            if (text_[at_] == '#') at_ = std::min(text_.find('\n', at_), text_.size());
            if (at_ == text_.size() || !is_blank(text_[at_])) return;
            if (text_[at_] == '\n') ++line_;
        }
    }

    Token scan() {
        skip_blanks();
        if (at_ == text_.size()) return {Kind::end, {}, line_};
        constexpr std::array<std::pair<char, Kind>, 4> marks{
            {{'{', Kind::open}, {'}', Kind::close}, {'[', Kind::open_list}, {']', Kind::close_list}}};
        for (const auto& [mark, kind] : marks)
            if (text_[at_] == mark) return {kind, text_.substr(at_++, 1), line_};
        return text_[at_] == '"' ? scan_string() : scan_word();
    }

    Token scan_word() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && !ends_word(text_[at_])) ++at_;
        return {Kind::word, text_.substr(begin, at_ - begin), line_};
    }

    // What is between the quotes, as it stands there.
    Token scan_string() {
        const std::size_t begin = ++at_, line = line_;
        for (; at_ < text_.size() && text_[at_] != '"'; ++at_) {
            if (text_[at_] == '\\') ++at_;
            if (at_ < text_.size() && text_[at_] == '\n') ++line_;
        }
        if (at_ >= text_.size()) fail_at_line(line, "expected the quote to close, found the end of the file");
        return {Kind::string, text_.substr(begin, at_++ - begin), line};
    }

    std::string_view text_;
    std::size_t at_ = 0, line_ = 1;
    Token ahead_;
};

std::string unescaped(std::string_view quoted) {
    std::string text;
    for (std::size_t i = 0; i < quoted.size(); ++i) {
        if (quoted[i] == '\\' && i + 1 < quoted.size()) ++i;
        text += quoted[i];
    }
    return text;
}

// A number; "+I" is how some programs write infinity.
std::optional<double> number_of(std::string_view word) {
    if (word == "+I" || word == "I") return std::numeric_limits<double>::infinity();
    if (word == "-I") return -std::numeric_limits<double>::infinity();
    const std::optional<double> number = parse_double(word);
    return number && std::isnan(*number) ? std::nullopt : number;
}

class Parser {
public:
    explicit Parser(std::string_view text) : tokens_(text) {}

    BifsText parse() {
        while (tokens_.peek().kind != Kind::end) {
            BifsField ignored;
            read_item(ignored, 0);
        }
        for (const auto& [node, field, child] : uses_) {
            BifsChild& use = result_.nodes[node].fields[field].nodes[child];
            const auto found = names_.find(use.use);
            if (found != names_.end()) use.node = found->second;
        }
        return std::move(result_);
    }

private:
    // One thing where a value may stand: a number, a string, a node, a word, or brackets that mean nothing here, as
    // those of a PROTO.
    void read_item(BifsField& field, std::size_t depth) {
        const Token token = tokens_.next();
        if (token.kind == Kind::end)
            fail_at_line(token.line, "expected the brackets to close, found the end of the file");
        if (token.kind == Kind::string) return field.strings.push_back(unescaped(token.text));
        if (token.kind == Kind::word) return read_word(field, token, depth);
        if (token.kind == Kind::close || token.kind == Kind::close_list)
            fail_at_line(token.line, fmt::format("expected a bracket that is open, found {} too many", token.text));
        skip_balanced(token, depth);
    }

    void read_word(BifsField& field, const Token& token, std::size_t depth) {
        if (const std::optional<double> number = number_of(token.text)) return field.numbers.push_back(*number);
        if (token.text == "NULL") return;
        if (token.text == "USE") return field.nodes.push_back({no_bifs_node, expect_word("a name after USE").text});
        if (token.text == "DEF") {
            const std::string_view name = expect_word("a name after DEF").text;
            return read_node(field, expect_word("a node after DEF"), name, depth);
        }
        if (tokens_.peek().kind == Kind::open) return read_node(field, token, {}, depth);
        if (field.word.empty()) field.word = token.text;
    }

    Token expect_word(std::string_view what) {
        const Token token = tokens_.next();
        if (token.kind != Kind::word)
            fail_at_line(token.line, fmt::format("expected {}, found {}", what,
                                                 token.kind == Kind::end ? "the end of the file" : shown(token.text)));
        return token;
    }

    void read_node(BifsField& field, const Token& type, std::string_view name, std::size_t depth) {
        check_depth(type.line, depth);
        const Token open = tokens_.next();
        if (open.kind != Kind::open)
            fail_at_line(open.line, fmt::format("expected {{ after {}, found {}", shown(type.text), shown(open.text)));
        const auto index = static_cast<std::uint32_t>(result_.nodes.size());
        result_.nodes.push_back({type.text, name, type.line, {}});
        if (!name.empty() && !names_.emplace(name, index).second)
            fail_at_line(type.line, fmt::format("expected names that differ, found DEF {} again", shown(name)));
        field.nodes.push_back({index, {}});
        while (tokens_.peek().kind != Kind::close) read_field(index, depth + 1);
        tokens_.next();
    }

    void read_field(std::uint32_t node, std::size_t depth) {
        const Token name = expect_word("a field or }");
        BifsField field{name.text, name.line, {}, {}, {}, {}};
        const Kind kind = tokens_.peek().kind;
        if (kind == Kind::open_list)
            read_list(field, depth);
        else if (is_scalar(tokens_.peek()))
            while (is_scalar(tokens_.peek())) read_item(field, depth);
        else if (kind != Kind::close)
            read_item(field, depth);
        for (std::size_t c = 0; c < field.nodes.size(); ++c)
            if (!field.nodes[c].use.empty()) uses_.push_back({node, result_.nodes[node].fields.size(), c});
        result_.nodes[node].fields.push_back(std::move(field));
    }

    static bool is_scalar(const Token& token) {
        return token.kind == Kind::string || (token.kind == Kind::word && number_of(token.text));
    }

    void read_list(BifsField& field, std::size_t depth) {
        check_depth(tokens_.next().line, depth);
        while (tokens_.peek().kind != Kind::close_list) read_item(field, depth + 1);
        tokens_.next();
    }

    static void check_depth(std::size_t line, std::size_t depth) {
        if (depth >= most_depth)
            fail_at_line(line, fmt::format("expected brackets at most {} deep, found deeper ones", most_depth));
    }

    // From an opening bracket to the one that closes it.
    void skip_balanced(const Token& first, std::size_t depth) {
        std::vector<Kind> open{first.kind};
        while (!open.empty()) {
            check_depth(first.line, depth + open.size() - 1);
            const Token token = tokens_.next();
            if (token.kind == Kind::end)
                fail_at_line(first.line, "expected the brackets to close, found the end of the file");
            if (token.kind == Kind::open || token.kind == Kind::open_list) open.push_back(token.kind);
            if (token.kind != Kind::close && token.kind != Kind::close_list) continue;
            if ((token.kind == Kind::close) != (open.back() == Kind::open))
                fail_at_line(token.line, fmt::format("expected the other bracket, found {}", token.text));
            open.pop_back();
        }
    }

    struct Use {
        std::uint32_t node;
        std::size_t field, child;
    };

    Tokens tokens_;
    BifsText result_;
    std::unordered_map<std::string_view, std::uint32_t> names_;
    std::vector<Use> uses_;
};

}  // namespace

[[noreturn]] void fail_at_line(std::size_t line, std::string_view sentence) {
    throw Error(fmt::format("fdp line {}: {}", line, sentence));
}

BifsText parse_bifs(std::span<const std::byte> bytes) {
    check_size(bytes, "fdp");
    check_text(bytes, "fdp");
    std::string_view text = as_text(bytes);
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    return Parser(text).parse();
}

const BifsField* find_field(const BifsNode& node, std::string_view name) {
    const auto found =
        std::find_if(node.fields.begin(), node.fields.end(), [&](const BifsField& f) { return f.name == name; });
    return found == node.fields.end() ? nullptr : &*found;
}

std::span<const double> numbers_of(const BifsNode& node, std::string_view name, std::size_t tuple) {
    const BifsField* field = find_field(node, name);
    if (field == nullptr) return {};
    if (!field->word.empty() || !field->strings.empty())
        fail_at_line(field->line, fmt::format("expected numbers for {}, found {}", name,
                                              shown(field->word.empty() ? field->strings.front() : field->word)));
    if (field->numbers.size() % tuple != 0)
        fail_at_line(field->line, fmt::format("expected a multiple of {} numbers for {}, found {}", tuple, name,
                                              field->numbers.size()));
    return field->numbers;
}

std::vector<std::int32_t> integers_of(const BifsNode& node, std::string_view name) {
    using Limits = std::numeric_limits<std::int32_t>;
    std::vector<std::int32_t> integers;
    for (const double number : numbers_of(node, name)) {
        if (!(number >= Limits::min() && number <= Limits::max()) || number != std::floor(number))
            fail_at_line(find_field(node, name)->line,
                         fmt::format("expected whole numbers of 32 bits for {}, found {}", name, number));
        integers.push_back(static_cast<std::int32_t>(number));
    }
    return integers;
}

const BifsNode* node_of(const BifsText& text, const BifsNode& node, std::string_view field, std::string_view type) {
    const BifsField* found = find_field(node, field);
    if (found == nullptr || found->nodes.empty()) return nullptr;
    const BifsChild& child = found->nodes.front();
    if (child.node == no_bifs_node)
        fail_at_line(found->line, fmt::format("expected a node called {} for {}, found none", shown(child.use), field));
    const BifsNode& result = text.nodes[child.node];
    if (result.type != type)
        fail_at_line(found->line, fmt::format("expected a node {} for {}, found {}", type, field, shown(result.type)));
    return &result;
}

Vec3 vector_of(const BifsNode& node, std::string_view field, const Vec3& otherwise) {
    const std::span<const double> numbers = numbers_of(node, field);
    if (numbers.empty()) return otherwise;
    const bool fits = numbers.size() == 3 &&
                      std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
    if (!fits)
        fail_at_line(find_field(node, field)->line,
                     fmt::format("expected three finite numbers for {}, found others", field));
    return {numbers[0], numbers[1], numbers[2]};
}

AxisAngle axis_angle_of(const BifsNode& node, std::string_view field) {
    const std::span<const double> numbers = numbers_of(node, field);
    if (numbers.empty()) return {};
    const auto fail = [&](std::string_view sentence) { fail_at_line(find_field(node, field)->line, sentence); };
    if (numbers.size() != 4)
        fail(fmt::format("expected an axis and an angle for {}, found {} numbers", field, numbers.size()));
    const Vec3 axis{numbers[0], numbers[1], numbers[2]};
    const double size = length(axis);
    if (!std::isfinite(size) || !std::isfinite(numbers[3]) || (!(size > 0) && numbers[3] != 0))
        fail(fmt::format("expected an axis that has a length and a finite angle for {}, found others", field));
    if (!(size > 0)) return {};
    return {std::abs(size - 1) < 1e-9 ? axis : axis / size, numbers[3]};
}

Affine map_of_transform(const BifsNode& node) {
    const Vec3 centre = vector_of(node, "center", {}), shift = vector_of(node, "translation", {});
    const Vec3 scale = vector_of(node, "scale", {1, 1, 1});
    const AxisAngle turn = axis_angle_of(node, "rotation"), tilt = axis_angle_of(node, "scaleOrientation");
    if (shift == Vec3{} && scale == Vec3{1, 1, 1} && turn.angle == 0) return {};
    const auto quaternion = [](const AxisAngle& a) {
        const Vec3 v = std::sin(a.angle / 2) * a.axis;
        return Quaternion{v.x, v.y, v.z, std::cos(a.angle / 2)};
    };
    const Quaternion tilted = quaternion(tilt);
    return affine_map(shift + centre, quaternion(turn), {1, 1, 1}) * affine_map({}, tilted, {1, 1, 1}) *
           affine_map({}, {}, scale) * affine_map({}, conjugate(tilted), {1, 1, 1}) *
           affine_map(-centre, {}, {1, 1, 1});
}

std::string bifs_name(std::string_view name) {
    constexpr std::string_view not_in_names = "\"#'+,-.\\[]{}%\x7f";
    std::string text;
    for (const char c : name) {
        const bool first_digit = text.empty() && c >= '0' && c <= '9';
        if (static_cast<unsigned char>(c) <= ' ' || not_in_names.find(c) != std::string_view::npos || first_digit)
            text += fmt::format("%{:02X}", static_cast<unsigned char>(c));
        else
            text += c;
    }
    return text;
}

std::string plain_name(std::string_view name) {
    name = name.substr(0, name.find("%_"));
    std::string text;
    for (std::size_t i = 0; i < name.size(); ++i) {
        unsigned char byte = 0;
        const char* digits = name.data() + i + 1;
        if (name[i] == '%' && i + 2 < name.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
            text += static_cast<char>(byte);
            i += 2;
        } else {
            text += name[i];
        }
    }
    return text;
}

}  // namespace mien
