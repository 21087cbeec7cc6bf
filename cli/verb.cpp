// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "verb.hpp"

#include <utility>

namespace mien::cli {

CLI::App* add_verb(CLI::App& app, Call& call, const std::string& name, const std::string& purpose,
                   const std::string& example, std::function<void()> work) {
    CLI::App* verb = app.add_subcommand(name, purpose);
    Common& flags = call.flags;
    verb->add_flag("--json", flags.json, "print one JSON object on stdout and nothing else there");
    verb->add_option("--report", flags.report, "write the same JSON object to this file");
    verb->add_flag("--dry-run", flags.dry_run, "do everything except writing files");
    verb->add_flag("-q,--quiet", flags.quiet, "print errors only");
    verb->add_flag("-v,--verbose", flags.verbose, "print every list in full");
    verb->add_flag("-f,--force", flags.force, "overwrite an output that is there");
    verb->add_option("--threads", flags.threads, "threads to use, 0 for all; the result is the same for any number")
        ->check(CLI::Range(0, 1024));
    verb->footer("Example:\n  " + example);
    verb->callback([&call, work = std::move(work)] { call.work = work; });
    return verb;
}

}  // namespace mien::cli
