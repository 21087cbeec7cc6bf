// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <filesystem>

#include "verb.hpp"

#include "mien/fap.hpp"
#include "mien/io/fba.hpp"

namespace mien::cli {

/// Whether a file holds face animation parameters, by its extension.
bool is_faps(const std::filesystem::path& file);

/// Reads a text file or a bitstream and tells the report what it sends; a stream that is cut is warned of.
FapStream load_faps(const std::filesystem::path& file, Report& report);

/// Flags of verbs that write face animation parameters.
struct FapOutput {
    std::filesystem::path output;
    FbaOptions stream;
};
void add_fap_output_flags(CLI::App& verb, FapOutput& flags);

/// Writes text (.fap) or a bitstream (.fba), and reports what the stream cost.
void write_faps(Call& call, const FapOutput& flags, const FapStream& stream);

}  // namespace mien::cli
