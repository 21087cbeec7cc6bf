// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <memory>

#include "inputs.hpp"
#include "outputs.hpp"
#include "parts.hpp"

#include "mien/algorithms/complete.hpp"
#include "mien/io/read.hpp"
#include "mien/io/write.hpp"

namespace mien::cli {

namespace {

struct RetargetTake {
    std::filesystem::path rig;
    PerformanceFlags performance;
    std::filesystem::path output;
    bool driven_only = false;
};

void retarget(Call& call, const RetargetTake& flags) {
    std::vector<std::filesystem::path> inputs = input_files(flags.performance);
    inputs.push_back(flags.rig);
    check_output(flags.output, inputs, call.flags);
    RigFile file = read_rig(flags.rig);
    const Face face{std::move(file.mesh), std::move(file.rig.points)};
    Take onto = load_performance(flags.performance, face, call.report);
    if (!flags.driven_only) onto = complete(face, onto);
    WriteOptions options;
    options.overwrite = call.flags.force;
    if (!call.flags.dry_run) write(onto, flags.output, options);
    call.report["wrote"] = {{"file", flags.output.string()}, {"rows", row_count(onto)}, {"points", onto.points.size()}};
    if (call.flags.dry_run) call.report["wrote"] = "nothing: this was a dry run";
}

}  // namespace

void add_retarget(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<RetargetTake>();
    CLI::App* verb = add_verb(app, call, "retarget", "Maps a performer's points to the points of a rigged face.",
                              "mien retarget smile.trc --rig kate-rig.glb --map markers.csv -o smile-on-kate.csv",
                              [&call, flags] { retarget(call, *flags); });
    add_performance_flags(*verb, flags->performance, "take");
    verb->add_option("--rig", flags->rig, "the rigged face (.glb written by mien rig)")->required();
    verb->add_flag("--driven-only", flags->driven_only,
                   "leave out the rig's points that the take does not drive, instead of carrying them with the skin");
    verb->add_option("-o,--output", flags->output, "the take to write: .csv .trc")->required();
}

}  // namespace mien::cli
