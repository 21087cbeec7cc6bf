// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <stdexcept>
#include <string>

namespace mien {

/// The one exception of the library: a sentence that names the thing, where it is, what was expected and what was
/// found, and, where it helps, what to do next. "obj line 12: expected a vertex index from 1 to 24, found 31".
///
/// Thrown at the border (files, packets, arguments from users) and by verbs that build something. Per-frame verbs never
/// throw. Parsers do not know the file's name: `read_*` puts "head.obj: " before their sentence.
class Error : public std::runtime_error {
public:
    enum class Kind {
        input,   ///< what was given is wrong (exit status 1)
        access,  ///< a file cannot be opened, read or written (exit status 3)
    };

    explicit Error(const std::string& sentence, Kind kind = Kind::input) : std::runtime_error(sentence), kind_(kind) {}

    [[nodiscard]] Kind kind() const noexcept { return kind_; }

private:
    Kind kind_;
};

}  // namespace mien
