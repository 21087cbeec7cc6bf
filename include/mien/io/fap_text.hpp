// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "mien/fap.hpp"

namespace mien {

struct FapTextOptions {
    /// FAPs 1 and 2 come as one number each, what is selected at full strength, as Greta reads and writes them; else as
    /// 4 numbers (select1 select2 blend def) and 6 (select1 intensity1 select2 intensity2 init_face def).
    bool single_numbers = false;
};

/// FAP text files: a header "version name fps frames", then for every frame a mask of 0 and 1 and "number value ...",
/// one value for each 1. Accepted are any version, names with blanks in them, more than 68 mask columns (the values of
/// the spare ones are read over), tabs, CR LF, records over several lines, `#` comments before any record, values with
/// a fraction (rounded) and frame numbers that begin anywhere and leave some out. The number of frames in the header is
/// not believed. A last frame that is cut is refused.
///
/// Throws Error naming the line, what was expected and what was found: a mask column other than 0 and 1, a value that
/// is missing, one too many, no number or beyond 32 bits, a viseme or an expression outside its range, a frame number
/// that does not rise, a file without frames.
FapStream parse_fap_text(std::span<const std::byte> bytes, const FapTextOptions& options = {});

/// The same file back: 68 columns, single blanks, LF. Throws Error when name or version cannot stand in the header or
/// the rate is not above 0.
std::string format_fap_text(const FapStream& stream);

}  // namespace mien
