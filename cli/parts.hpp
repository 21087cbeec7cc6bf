// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "inputs.hpp"

#include "mien/algorithms/partial.hpp"

namespace mien::cli {

/// One or two and more takes, and which parts of the face each of them moves.
struct PerformanceFlags {
    std::vector<std::filesystem::path> takes;
    TakeFlags take;  ///< what is done to each of them
    RetargetOptions retarget;
    std::vector<std::string> only;  ///< parts by commas; with several takes, one text for each
    std::vector<std::string> without;
    std::vector<std::string> strengths;  ///< PART=NUMBER
    std::vector<std::string> sealed;     ///< POINT=NUMBER
    bool depth = true;                   ///< estimated for takes from a picture
};

/// Parts and numbers out of texts such as "mouth=1.2,brows=0.5", and the flag that takes such texts.
std::vector<PartStrength> part_strengths(const std::vector<std::string>& texts);
CLI::Option* add_strength_flag(CLI::App& verb, std::vector<std::string>& strengths, const std::string& help);

/// `take_name`: how the verb takes its takes, as an option or by their place.
void add_performance_flags(CLI::App& verb, PerformanceFlags& flags, const std::string& take_name);

/// Every file that is read.
std::vector<std::filesystem::path> input_files(const PerformanceFlags& flags);

/// Reads every take, holds the parts that do not move, retargets, merges, and tells the report.
Take load_performance(const PerformanceFlags& flags, const Face& face, Report& report);

}  // namespace mien::cli
