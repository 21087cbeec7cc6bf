// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// C3D as its user guide describes it (c3d.org): blocks of 512 bytes, numbered from 1. Block 1 is a header of 16-bit
// words; then come parameters, a chain of groups and of values in them; then the frames, each with four words per point
// (x, y, z, residual) and the analog samples taken meanwhile. A negative scale in the header says that the words of the
// frames are real numbers, else they are integers of 16 bits that the scale turns into lengths. The processor that
// wrote the file, stated in the parameters, tells how numbers of the whole file lie: little end first (PC), the same
// with real numbers of the VAX (DEC), or big end first (SGI).
//
// The header counts frames with 16 bits. Longer files state their ends in TRIAL:ACTUAL_START_FIELD and
// ACTUAL_END_FIELD, low word first, or their number in POINT:LONG_FRAMES; those that state neither stop counting at
// 65535, and what follows in the file belongs to them.

#include "mien/io/c3d.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text.hpp"
#include "io/tracks_text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::size_t block = 512;
constexpr std::uint16_t most_counted = 65535;
constexpr std::uint64_t all_there_are = std::numeric_limits<std::uint64_t>::max();

[[noreturn]] void fail(const std::string& sentence) {
    throw Error("c3d: " + sentence);
}

enum class Processor { pc = 84, dec = 85, sgi = 86 };

// A real number of the VAX: the exponent counts from 128, the mantissa lies in [0.5, 1), and an exponent of 0 is zero.
float vax_real(std::uint32_t word) {
    const auto exponent = static_cast<int>((word >> 23) & 0xffU);
    if (exponent == 0) return 0;
    const double mantissa = ((word & 0x7fffffU) | 0x800000U) / 16777216.0;
    return static_cast<float>(std::ldexp((word >> 31) != 0 ? -mantissa : mantissa, exponent - 128));
}

// The bytes of the file as numbers of its processor.
class Numbers {
public:
    explicit Numbers(std::span<const std::byte> bytes) : bytes_(bytes) {}

    void set(Processor processor) { processor_ = processor; }
    [[nodiscard]] std::size_t size() const { return bytes_.size(); }

    [[nodiscard]] bool has(std::size_t at, std::size_t count) const {
        return at <= bytes_.size() && count <= bytes_.size() - at;
    }
    [[nodiscard]] std::uint8_t byte(std::size_t at) const {
        if (!has(at, 1)) fail(fmt::format("byte {}: expected more, found the end of the file", at));
        return std::to_integer<std::uint8_t>(bytes_[at]);
    }
    [[nodiscard]] std::int8_t signed_byte(std::size_t at) const { return static_cast<std::int8_t>(byte(at)); }
    [[nodiscard]] std::uint16_t word(std::size_t at) const {
        const unsigned first = byte(at), second = byte(at + 1);
        return static_cast<std::uint16_t>(processor_ == Processor::sgi ? first << 8 | second : second << 8 | first);
    }
    [[nodiscard]] std::int16_t signed_word(std::size_t at) const { return static_cast<std::int16_t>(word(at)); }
    [[nodiscard]] float real(std::size_t at) const {
        const std::uint32_t first = word(at), second = word(at + 2);
        if (processor_ == Processor::dec) return vax_real(first << 16 | second);
        return std::bit_cast<float>(processor_ == Processor::sgi ? first << 16 | second : second << 16 | first);
    }
    [[nodiscard]] std::string_view text(std::size_t at, std::size_t size) const {
        return has(at, size) ? as_text(bytes_.subspan(at, size)) : std::string_view();
    }

private:
    std::span<const std::byte> bytes_;
    Processor processor_ = Processor::pc;
};

// A value of the parameter section; its data lies within the file.
struct Parameter {
    int group = 0;
    std::string_view name;
    int type = 0;                          // -1 text, 1 bytes, 2 words, 4 real numbers
    std::vector<std::uint8_t> dimensions;  // the first one runs fastest
    std::size_t data = 0;                  // offset in the file
    std::size_t count = 0;                 // of elements
};

struct Group {
    int id = 0;
    std::string_view name;
};

// Where and how long a value is; nothing when it does not lie in the file or is of no known type.
std::optional<Parameter> parameter_at(const Numbers& file, std::size_t at, int group, std::string_view name) {
    Parameter parameter{group, name, file.signed_byte(at), {}, 0, 1};
    if (const int t = parameter.type; t != -1 && t != 1 && t != 2 && t != 4) return std::nullopt;
    const std::size_t dimensions = file.byte(at + 1);
    for (std::size_t d = 0; d < dimensions; ++d) {
        parameter.dimensions.push_back(file.byte(at + 2 + d));
        parameter.count *= parameter.dimensions.back();
        if (parameter.count > file.size()) return std::nullopt;
    }
    parameter.data = at + 2 + dimensions;
    const std::size_t size = parameter.count * static_cast<std::size_t>(std::abs(parameter.type));
    return file.has(parameter.data, size) ? std::optional(std::move(parameter)) : std::nullopt;
}

class Parameters {
public:
    // Follows the chain. Every link leads forwards, so that no file holds it up.
    Parameters(const Numbers& file, std::size_t first, std::size_t end) : file_(file) {
        for (std::size_t at = first; at + 2 <= end;) {
            const auto size = static_cast<std::size_t>(std::abs(int{file.signed_byte(at)}));
            const std::size_t link = at + 2 + size;
            if (size == 0 || link + 2 > end) return;
            add(file.signed_byte(at + 1), file.text(at + 2, size), link + 2);
            const int step = file.signed_word(link);
            if (step < 2) return;
            at = link + static_cast<std::size_t>(step);
        }
    }

    [[nodiscard]] const Parameter* find(std::string_view group, std::string_view name) const {
        for (const Parameter& parameter : parameters_)
            if (equal_but_case(parameter.name, name) && is_in(parameter, group)) return &parameter;
        return nullptr;
    }

    // The first number of a value, whatever its type; nothing where there is none.
    [[nodiscard]] std::optional<double> number(std::string_view group, std::string_view name) const {
        const Parameter* found = find(group, name);
        if (found == nullptr || found->count == 0 || found->type < 2) return std::nullopt;
        return found->type == 4 ? file_.real(found->data) : file_.word(found->data);
    }

    // A number of 32 bits in two words, the low one first.
    [[nodiscard]] std::optional<std::uint64_t> long_number(std::string_view group, std::string_view name) const {
        const Parameter* found = find(group, name);
        if (found == nullptr || found->count != 2 || found->type != 2) return std::nullopt;
        return std::uint64_t{file_.word(found->data)} + (std::uint64_t{file_.word(found->data + 2)} << 16);
    }

    // Rows of characters without the blanks and zeros that fill them up.
    [[nodiscard]] std::vector<std::string> texts(std::string_view group, std::string_view name) const {
        const Parameter* found = find(group, name);
        std::vector<std::string> rows;
        if (found == nullptr || found->type != -1 || found->count == 0) return rows;
        const std::size_t width = found->dimensions.empty() ? 1 : found->dimensions.front();
        for (std::size_t at = 0; at < found->count; at += width) {
            const std::string_view row = file_.text(found->data + at, width);
            rows.emplace_back(trimmed(row.substr(0, row.find('\0'))));
        }
        return rows;
    }

private:
    void add(int id, std::string_view name, std::size_t at) {
        if (id < 0) {
            groups_.push_back({-id, name});
        } else if (file_.has(at, 2)) {
            if (auto parameter = parameter_at(file_, at, id, name)) parameters_.push_back(std::move(*parameter));
        }
    }

    [[nodiscard]] bool is_in(const Parameter& parameter, std::string_view group) const {
        return std::any_of(groups_.begin(), groups_.end(),
                           [&](const Group& g) { return g.id == parameter.group && equal_but_case(g.name, group); });
    }

    const Numbers& file_;
    std::vector<Group> groups_;
    std::vector<Parameter> parameters_;
};

// What is needed to find the samples.
struct Layout {
    std::size_t points = 0, analog = 0;  // analog samples in a frame
    std::uint64_t frames = 0;            // as promised; or all that there are
    std::size_t data = 0;                // offset of the first frame
    bool real = false;
    double scale = 1, rate = 0;

    [[nodiscard]] std::size_t word() const { return real ? 4 : 2; }
    [[nodiscard]] std::size_t frame() const { return word() * (4 * points + analog); }
};

// Where a block begins that the file has to have, with four bytes at least.
std::size_t block_at(const Numbers& file, double number, std::string_view what) {
    const std::size_t blocks = (file.size() + block - 5) / block;
    if (!(number >= 2 && number <= static_cast<double>(blocks)))
        fail(fmt::format("expected {} in a block from 2 to {}, found block {}", what, blocks, number));
    return (static_cast<std::size_t>(number) - 1) * block;
}

std::size_t parameter_section(Numbers& file) {
    if (file.size() < block) fail(fmt::format("expected a header of {} bytes, found {}", block, file.size()));
    if (file.byte(1) != 0x50) fail(fmt::format("expected 80 as the second byte, found {}", file.byte(1)));
    const std::size_t at = block_at(file, file.byte(0), "parameters");
    const int processor = file.byte(at + 3);
    if (processor < 84 || processor > 86)
        fail(fmt::format("expected the number of a processor, 84 (PC), 85 (DEC) or 86 (SGI), found {}", processor));
    file.set(static_cast<Processor>(processor));
    return at;
}

std::uint64_t promised_frames(const Numbers& file, const Parameters& parameters) {
    const auto first = parameters.long_number("TRIAL", "ACTUAL_START_FIELD");
    const auto last = parameters.long_number("TRIAL", "ACTUAL_END_FIELD");
    if (first && last && *last >= *first && *last > 0) return *last - *first + 1;
    if (const auto frames = parameters.number("POINT", "LONG_FRAMES"); frames && *frames >= 1 && *frames < 4e9)
        return static_cast<std::uint64_t>(*frames);
    const std::uint16_t from = file.word(6), to = file.word(8);
    if (to < from || to == 0) fail(fmt::format("expected frames, found none: from {} to {}", from, to));
    return to == most_counted ? all_there_are : std::uint64_t{to} - from + 1;
}

double read_rate(const Numbers& file, const Parameters& parameters) {
    const double header = file.real(20);
    const double rate = header > 0 ? header : parameters.number("POINT", "RATE").value_or(header);
    if (!(rate > 0) || !std::isfinite(rate)) fail(fmt::format("expected a rate above 0, found {}", rate));
    return rate;
}

double read_scale(const Numbers& file, const Parameters& parameters) {
    const double header = file.real(12);
    const double scale = header != 0 ? header : parameters.number("POINT", "SCALE").value_or(header);
    if (scale == 0 || !std::isfinite(scale)) fail(fmt::format("expected a scale other than 0, found {}", scale));
    return scale;
}

Layout read_layout(const Numbers& file, const Parameters& parameters) {
    Layout layout;
    layout.points = file.word(2);
    layout.analog = file.word(4);
    if (layout.points == 0) fail("expected points, found none in a frame");
    layout.frames = promised_frames(file, parameters);
    layout.scale = read_scale(file, parameters);
    layout.real = layout.scale < 0;
    layout.rate = read_rate(file, parameters);
    const double first = file.word(16) != 0 ? file.word(16) : parameters.number("POINT", "DATA_START").value_or(0);
    layout.data = block_at(file, first, "frames");
    return layout;
}

std::vector<std::string> read_names(const Parameters& parameters, std::size_t points) {
    std::vector<std::string> names = parameters.texts("POINT", "LABELS");
    for (int more = 2; names.size() < points; ++more) {
        const std::vector<std::string> next = parameters.texts("POINT", fmt::format("LABELS{}", more));
        if (next.empty()) break;
        names.insert(names.end(), next.begin(), next.end());
    }
    names.resize(points);
    for (std::size_t p = 0; p < points; ++p)
        if (names[p].empty()) names[p] = fmt::format("point {}", p + 1);
    return names;
}

std::string read_unit(const Parameters& parameters) {
    const std::vector<std::string> units = parameters.texts("POINT", "UNITS");
    for (const std::string_view unit : {"mm", "cm", "m"})
        if (!units.empty() && equal_but_case(units.front(), unit)) return std::string(unit);
    return {};
}

Vec3 sample_at(const Numbers& file, const Layout& layout, std::size_t at) {
    const auto number = [&](std::size_t i) -> double {
        return layout.real ? file.real(at + 4 * i) : file.signed_word(at + 2 * i);
    };
    const double scale = layout.real ? 1 : layout.scale;
    const Vec3 place{scale * number(0), scale * number(1), scale * number(2)};
    const auto is_coordinate = [](double x) { return std::abs(x) <= largest_coordinate; };
    const bool seen = number(3) >= 0 && is_coordinate(place.x) && is_coordinate(place.y) && is_coordinate(place.z);
    return seen ? place : lost_sample;
}

void read_frames(const Numbers& file, const Layout& layout, Take& take) {
    const std::uint64_t whole = (file.size() - layout.data) / layout.frame();
    const std::uint64_t promised = layout.frames == all_there_are ? whole : layout.frames;
    const auto frames = static_cast<std::size_t>(std::min(promised, whole));
    if (frames == 0) fail(fmt::format("expected frames of {} bytes, found no whole one", layout.frame()));
    take.missing_rows = static_cast<std::size_t>(promised - frames);
    take.samples.reserve(frames * layout.points);
    for (std::size_t f = 0; f < frames; ++f) {
        take.times.push_back(static_cast<double>(f) / layout.rate);
        for (std::size_t p = 0; p < layout.points; ++p)
            take.samples.push_back(sample_at(file, layout, layout.data + f * layout.frame() + 4 * layout.word() * p));
    }
}

}  // namespace

Take parse_c3d(std::span<const std::byte> bytes) {
    Numbers file(bytes);
    const std::size_t section = parameter_section(file);
    const std::size_t blocks = file.byte(section + 2);
    const std::size_t end = blocks > 0 ? std::min(section + blocks * block, file.size()) : file.size();
    const Parameters parameters(file, section + 4, end);
    const Layout layout = read_layout(file, parameters);
    Take take;
    take.points = read_names(parameters, layout.points);
    if (const std::string odd = odd_names(take); !odd.empty()) fail(odd);
    take.unit = read_unit(parameters);
    read_frames(file, layout, take);
    check_seen(take, "c3d");
    return take;
}

}  // namespace mien
