// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mien {

/// Whose names shapes go by.
enum class ShapeSet {
    arkit,    ///< the 52 of Apple's ARKit, "jawOpen"
    visemes,  ///< the 15 mouth shapes of Oculus, by their common names, "viseme_aa"
    vrm,      ///< the 18 preset expressions of VRM 1.0, "happy"
};

/// A share of an ARKit shape in another shape. A name without a side ("mouthSmile") stands for its two sides.
struct ShapePart {
    std::string_view shape;
    double weight = 0;
};

/// A shape that programs know by name.
struct NamedShape {
    std::string_view name;
    ShapeSet set = ShapeSet::arkit;
    std::span<const ShapePart> parts;  ///< of which ARKit shapes it is the sum; none for ARKit's own and for rest
};

/// All of them: each set in the order of its standard.
std::span<const NamedShape> named_shapes();

/// The shape that a file's own name means: the standard's name itself, or with the spellings that are about, "JawOpen",
/// "eyeBlink_L", "eyeBlink_R". Nothing for any other name.
std::optional<std::string_view> standard_shape(std::string_view name);

/// The shape of the other side of the face: "jawRight" for "jawLeft"; the shape itself where there is none.
std::string_view mirror_shape(std::string_view name);

/// The ARKit shapes that a part stands for: itself, or its two sides. Views into `named_shapes`.
struct ShapeSides {
    std::string_view first, second;  ///< `second` is empty where there is one
};
ShapeSides sides_of(std::string_view part);

}  // namespace mien
