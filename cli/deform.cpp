// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/deform.hpp"

#include <memory>

#include "inputs.hpp"
#include "outputs.hpp"

#include "mien/algorithms/complete.hpp"
#include "mien/io/read.hpp"

namespace mien::cli {

namespace {

struct DeformRig {
    std::filesystem::path rig;
    std::filesystem::path take;
    OutputFlags output;
};

void deform(Call& call, const DeformRig& flags) {
    check_output(flags.output.output, {flags.rig, flags.take}, call.flags);
    RigFile file = read_rig(flags.rig);
    const Take take = read_take(flags.take);
    const TakeBinding binding = bind_take(file.rig, take);
    call.report["rig"] = {{"file", flags.rig.filename().string()}, {"points", file.rig.points.size()}};
    call.report["take"] = {{"file", flags.take.filename().string()}, {"rows", row_count(take)}};
    call.report["points_carried_by_the_skin"] = binding.missing;
    call.report["columns_not_used"] = binding.unused;
    write_performance(call, flags.output, file.mesh, file.rig, complete({file.mesh, file.rig.points}, take));
}

}  // namespace

void add_deform(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<DeformRig>();
    CLI::App* verb = add_verb(app, call, "deform", "Moves every vertex of a rigged face by a take of its own points.",
                              "mien deform kate-rig.glb smile-on-kate.csv -o kate-smiles.mdd",
                              [&call, flags] { deform(call, *flags); });
    verb->add_option("rig", flags->rig, "the rigged face (.glb written by mien rig)")->required();
    verb->add_option("take", flags->take, "a take of this face's points, as mien retarget writes it: .csv .trc")
        ->required();
    add_output_flags(*verb, flags->output);
}

}  // namespace mien::cli
