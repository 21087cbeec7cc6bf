// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <memory>

#include "inputs.hpp"
#include "outputs.hpp"
#include "parts.hpp"

#include "mien/error.hpp"

namespace mien::cli {

namespace {

struct Animate {
    FaceFlags face;
    PerformanceFlags performance;
    OutputFlags output;
};

// The rig is bound to the points that the take drives and to no others: a point that nobody moves would hold its
// surroundings fast, and an island whose own points are not driven is attached instead.
void animate(Call& call, Animate& flags) {
    std::vector<std::filesystem::path> inputs = input_files(flags.performance);
    const std::vector<std::filesystem::path> of_face = input_files(flags.face);
    inputs.insert(inputs.end(), of_face.begin(), of_face.end());
    check_output(flags.output.output, inputs, call.flags);
    const Face face = load_face(flags.face, call.report);
    flags.performance.retarget.reading = flags.face.rig.reading;
    const Take onto = load_performance(flags.performance, face, call.report);
    const Examples examples = load_examples(face, flags.face, call.report);
    const Rig rig = bind_rig(with_points(face, onto.points), examples, flags.face, call.report);
    write_performance(call, flags.output, face.mesh, rig, onto);
}

}  // namespace

void add_animate(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<Animate>();
    CLI::App* verb = add_verb(app, call, "animate", "Makes a head perform a take: rig, retarget and deform in one.",
                              "mien animate kate.glb --points kate.json --take smile.trc --map markers.csv -o out.glb",
                              [&call, flags] { animate(call, *flags); });
    add_face_flags(*verb, flags->face);
    add_performance_flags(*verb, flags->performance, "--take");
    add_output_flags(*verb, flags->output);
}

}  // namespace mien::cli
