// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

#include "report.hpp"

namespace mien::cli {

/// The flags that every verb has.
struct Common {
    bool json = false;
    bool dry_run = false;
    bool quiet = false;
    bool verbose = false;
    bool force = false;
    int threads = 0;
    std::filesystem::path report;
};

/// One call of the program: its flags, the work of its verb, and what the verb has to say.
struct Call {
    Common flags;
    std::function<void()> work;
    Report report = Report::object();
    std::string text;  ///< what people read instead of the report's lines; empty: those
    std::string gate;  ///< why a quality gate was not met, for verbs that tell all the same; empty: it was
};

/// A quality gate that the user asked for was not met (exit status 4).
class GateError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Adds a verb with the common flags and an example under its help; `work` runs when it is called.
CLI::App* add_verb(CLI::App& app, Call& call, const std::string& name, const std::string& purpose,
                   const std::string& example, std::function<void()> work);

/// One per verb: declares its flags and its work.
void add_animate(CLI::App& app, Call& call);
void add_inspect(CLI::App& app, Call& call);
void add_points(CLI::App& app, Call& call);
void add_rig(CLI::App& app, Call& call);
void add_retarget(CLI::App& app, Call& call);
void add_deform(CLI::App& app, Call& call);
void add_render(CLI::App& app, Call& call);
void add_faps(CLI::App& app, Call& call);
void add_play(CLI::App& app, Call& call);
void add_encode(CLI::App& app, Call& call);
void add_decode(CLI::App& app, Call& call);
void add_fap(CLI::App& app, Call& call);
void add_morph(CLI::App& app, Call& call);
void add_evaluate(CLI::App& app, Call& call);
void add_shapes(CLI::App& app, Call& call);
void add_fat(CLI::App& app, Call& call);

}  // namespace mien::cli
