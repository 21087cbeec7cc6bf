// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <filesystem>

#include "verb.hpp"

#include "mien/fap.hpp"
#include "mien/fdp.hpp"
#include "mien/io/fba.hpp"
#include "mien/io/fdp_text.hpp"

namespace mien::cli {

/// Whether a file holds face animation parameters, by its extension.
bool is_faps(const std::filesystem::path& file);

/// Reads a text file or a bitstream and tells the report what it sends; a stream that is cut is warned of.
FapStream load_faps(const std::filesystem::path& file, Report& report);

/// Whether a file holds a face definition, by its extension.
bool is_fdp(const std::filesystem::path& file);

/// Flags of verbs that read face definitions, and what they mean.
struct FdpFlags {
    std::string displacements = "units";
    std::string below_zero = "signed";
};
void add_fdp_flags(CLI::App& verb, FdpFlags& flags);
FdpTextOptions fdp_options(const FdpFlags& flags);

/// Tells the report what a face definition holds: points, units and, parameter by parameter, the table.
void report_fdp(const Fdp& fdp, Report& report);

/// Flags of verbs that write face animation parameters.
struct FapOutput {
    std::filesystem::path output;
    FbaOptions stream;
};
void add_fap_output_flags(CLI::App& verb, FapOutput& flags);

/// Writes text (.fap) or a bitstream (.fba), and reports what the stream cost.
void write_faps(Call& call, const FapOutput& flags, const FapStream& stream);

}  // namespace mien::cli
