// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// BIFS text as a tree of nodes with fields, whatever their types: words, numbers and quoted strings between braces and
// brackets, commas as blanks, comments from # to the end of the line, DEF and USE.

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mien/affine.hpp"

namespace mien {

inline constexpr std::uint32_t no_bifs_node = std::numeric_limits<std::uint32_t>::max();

/// A node in the place of a value: there, or named by USE, which finds it wherever in the file it is defined.
struct BifsChild {
    std::uint32_t node = no_bifs_node;  ///< none: nothing in the file has that name
    std::string_view use;               ///< empty: it stands there itself
};

struct BifsField {
    std::string_view name;
    std::size_t line = 0;
    std::vector<double> numbers;  ///< none of them NaN; infinite ones are possible
    std::vector<std::string> strings;
    std::vector<BifsChild> nodes;
    std::string_view word;  ///< the first of another kind: TRUE, or a number with letters in it; empty: none
};

struct BifsNode {
    std::string_view type, name;  ///< the name by DEF; empty: none
    std::size_t line = 0;
    std::vector<BifsField> fields;
};

/// Views into the text that it was parsed from.
struct BifsText {
    std::vector<BifsNode> nodes;  ///< in the order in which they begin
};

/// Throws Error naming the line: brackets that do not fit or lie deeper than 64, a string without end, a NUL byte, a
/// name defined twice.
BifsText parse_bifs(std::span<const std::byte> bytes);

[[noreturn]] void fail_at_line(std::size_t line, std::string_view sentence);

/// The field of that name, or nothing.
const BifsField* find_field(const BifsNode& node, std::string_view name);

/// The numbers of a field, a multiple of `tuple`; none where there is no such field. Throws Error.
std::span<const double> numbers_of(const BifsNode& node, std::string_view name, std::size_t tuple = 1);

/// The same, all of them whole numbers of 32 bits.
std::vector<std::int32_t> integers_of(const BifsNode& node, std::string_view name);

/// The node in a field, or nothing; throws Error if USE names none, or it is of another type.
const BifsNode* node_of(const BifsText& text, const BifsNode& node, std::string_view field, std::string_view type);

/// A vector in a field, or what stands for it where there is none. Throws Error if it has other than three numbers.
Vec3 vector_of(const BifsNode& node, std::string_view field, const Vec3& otherwise);

/// The turn in a field (axis and angle in radians), by default none: its axis of length 1, and the angle.
struct AxisAngle {
    Vec3 axis{0, 0, 1};
    double angle = 0;
};
AxisAngle axis_angle_of(const BifsNode& node, std::string_view field);

/// What a Transform node does to its children. Exactly nothing where its fields have their defaults.
Affine map_of_transform(const BifsNode& node);

/// A name as DEF may have it: what may not stand there as %20. `plain_name` undoes it, and forgets what follows "%_".
std::string bifs_name(std::string_view name);
std::string plain_name(std::string_view name);

}  // namespace mien
