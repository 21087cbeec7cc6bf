// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <memory>

#include "inputs.hpp"
#include "outputs.hpp"

#include "mien/algorithms/complete.hpp"
#include "mien/io/read.hpp"
#include "mien/io/write.hpp"

namespace mien::cli {

namespace {

struct RetargetTake {
    std::filesystem::path rig;
    TakeFlags take;
    RetargetOptions retarget;
    std::filesystem::path output;
    bool driven_only = false;
};

void retarget(Call& call, RetargetTake& flags) {
    check_output(flags.output, {flags.rig, flags.take.take, flags.take.map}, call.flags);
    RigFile file = read_rig(flags.rig);
    const Face face{std::move(file.mesh), std::move(file.rig.points)};
    const Take take = load_take(flags.take, call.report);
    flags.retarget.neutral = flags.take.neutral;
    Take onto = load_onto(take, face, flags.retarget, call.report);
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
    verb->add_option("take", flags->take.take, "the performance: .trc .csv")->required();
    verb->add_option("--rig", flags->rig, "the rigged face (.glb written by mien rig)")->required();
    add_take_flags(*verb, flags->take);
    add_retarget_flags(*verb, flags->retarget);
    verb->add_flag("--driven-only", flags->driven_only,
                   "leave out the rig's points that the take does not drive, instead of carrying them with the skin");
    verb->add_option("-o,--output", flags->output, "the take to write: .csv .trc")->required();
}

}  // namespace mien::cli
