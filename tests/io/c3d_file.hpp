// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Makes C3D files of every number format, for tests: from their own description, not by the reader's code.

#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mien::c3d {

enum class Machine { pc = 84, dec = 85, sgi = 86 };

/// A point in a frame; a negative residual says that it was lost.
struct Sample {
    float x = 0, y = 0, z = 0, residual = 0;
};

struct Contents {
    Machine machine = Machine::pc;
    bool real = true;
    float scale = 0.5F;  // of integers
    std::vector<std::string> labels{"chin", "brow"};
    std::vector<std::vector<Sample>> frames{{{1, 2, 3, 0}, {4, -5, 6, 1}}, {{1.5, 2, 3, 0}, {0, 0, 0, -1}}};
    std::uint16_t first = 1, last = 2;
    std::uint16_t analog = 1;  // samples per frame, of nothing that matters
    float rate = 50;
    std::uint64_t actual_end = 0;  // above 0: TRIAL:ACTUAL_START_FIELD (1) and ACTUAL_END_FIELD
    std::size_t label_width = 6;
};

class Writer {
public:
    explicit Writer(Machine machine) : machine_(machine) {}

    std::string bytes;

    void byte(int value) { bytes += static_cast<char>(value); }
    void word(std::uint16_t value) {
        const int low = value & 0xff, high = value >> 8;
        byte(machine_ == Machine::sgi ? high : low);
        byte(machine_ == Machine::sgi ? low : high);
    }
    void real(float value) {
        const auto bits = machine_ == Machine::dec ? vax(value) : std::bit_cast<std::uint32_t>(value);
        const auto low = static_cast<std::uint16_t>(bits & 0xffffU), high = static_cast<std::uint16_t>(bits >> 16);
        const bool high_first = machine_ != Machine::pc;
        word(high_first ? high : low);
        word(high_first ? low : high);
    }
    void fill_block() { bytes.resize((bytes.size() + 511) / 512 * 512); }

private:
    // F format: sign, exponent from 128 of a mantissa in [0.5, 1), 23 bits behind its first one.
    static std::uint32_t vax(float value) {
        if (value == 0) return 0;
        int exponent = 0;
        const double mantissa = std::frexp(std::abs(value), &exponent);
        const auto fraction = static_cast<std::uint32_t>(std::ldexp(mantissa, 24)) & 0x7fffffU;
        return (value < 0 ? 0x80000000U : 0U) | static_cast<std::uint32_t>(exponent + 128) << 23 | fraction;
    }

    Machine machine_;
};

inline void add_group(Writer& out, int id, std::string_view name) {
    out.byte(static_cast<int>(name.size()));
    out.byte(-id);
    out.bytes += name;
    out.word(3);
    out.byte(0);
}

/// A value of a group: its type, its dimensions and its bytes; no description.
inline void add_value(Writer& out, int group, std::string_view name, int type, const std::vector<int>& dimensions,
                      const std::string& data) {
    out.byte(static_cast<int>(name.size()));
    out.byte(group);
    out.bytes += name;
    out.word(static_cast<std::uint16_t>(2 + 2 + dimensions.size() + data.size() + 1));
    out.byte(type);
    out.byte(static_cast<int>(dimensions.size()));
    for (const int dimension : dimensions) out.byte(dimension);
    out.bytes += data + '\0';
}

inline std::string parameters(const Contents& contents) {
    Writer out(contents.machine);
    out.bytes = std::string("\1\x50\1", 3);
    out.byte(static_cast<int>(contents.machine));
    add_group(out, 1, "POINT");
    add_group(out, 2, "TRIAL");
    for (std::size_t first = 0; first < contents.labels.size(); first += 255) {
        std::string labels;
        const std::size_t end = std::min(contents.labels.size(), first + 255);
        for (std::size_t i = first; i < end; ++i) {
            std::string label = contents.labels[i];
            label.resize(contents.label_width, ' ');
            labels += label;
        }
        const std::string name = first == 0 ? "LABELS" : fmt::format("LABELS{}", first / 255 + 1);
        add_value(out, 1, name, -1, {static_cast<int>(contents.label_width), static_cast<int>(end - first)}, labels);
    }
    add_value(out, 1, "UNITS", -1, {4}, "mm  ");
    if (contents.actual_end > 0) {
        for (const auto& [name, value] :
             {std::pair{"ACTUAL_START_FIELD", std::uint64_t{1}}, std::pair{"ACTUAL_END_FIELD", contents.actual_end}}) {
            Writer words(contents.machine);
            words.word(static_cast<std::uint16_t>(value & 0xffffU));
            words.word(static_cast<std::uint16_t>(value >> 16));
            add_value(out, 2, name, 2, {2}, words.bytes);
        }
    }
    out.byte(0);
    out.byte(0);
    out.fill_block();
    out.bytes[2] = static_cast<char>(out.bytes.size() / 512);
    return out.bytes;
}

inline std::string file(const Contents& contents) {
    const std::string section = parameters(contents);
    Writer out(contents.machine);
    out.bytes = "\2\x50";
    out.word(static_cast<std::uint16_t>(contents.labels.size()));
    out.word(contents.analog);
    out.word(contents.first);
    out.word(contents.last);
    out.word(0);
    out.real(contents.real ? -contents.scale : contents.scale);
    out.word(static_cast<std::uint16_t>(2 + section.size() / 512));
    out.word(1);
    out.real(contents.rate);
    out.fill_block();
    out.bytes += section;
    const auto number = [&](float value, float scale) {
        if (contents.real)
            out.real(value);
        else
            out.word(static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(value / scale))));
    };
    for (const auto& frame : contents.frames) {
        for (const Sample& sample : frame) {
            for (const float value : {sample.x, sample.y, sample.z}) number(value, contents.scale);
            number(sample.residual, 1);
        }
        for (int i = 0; i < contents.analog; ++i) number(7, 1);
    }
    out.fill_block();
    return out.bytes;
}

}  // namespace mien::c3d
