// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <memory>

#include "inputs.hpp"
#include "outputs.hpp"
#include "rig_picture.hpp"

#include "mien/io/gltf.hpp"
#include "mien/io/png.hpp"
#include "mien/io/write.hpp"

namespace mien::cli {

namespace {

struct MakeRig {
    FaceFlags face;
    OutputFlags output;
    std::filesystem::path picture;
};

void rig(Call& call, const MakeRig& flags) {
    std::vector<std::filesystem::path> inputs = input_files(flags.face);
    check_output(flags.output.output, inputs, call.flags);
    inputs.push_back(flags.output.output);
    check_output(flags.picture, inputs, call.flags);
    const Face face = load_face(flags.face, call.report);
    const Rig rig = bind_rig(face, load_examples(face, flags.face, call.report), flags.face, call.report);
    const Skin skin = skin_for(call, flags.output, face.mesh, rig, Take{});
    write_output(call, flags.output.output, format_rig(face.mesh, rig, skin));
    if (flags.picture.empty() || call.flags.dry_run) return;
    WriteOptions options;
    options.overwrite = call.flags.force;
    write_file(flags.picture, format_png(rig_picture(flags.face.head.stem().string(), face.mesh, rig)), options);
    call.report["picture"] = flags.picture.string();
}

}  // namespace

void add_rig(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<MakeRig>();
    CLI::App* verb =
        add_verb(app, call, "rig", "Binds a head to its feature points: a .glb that any engine loads.",
                 "mien rig kate.glb --points kate.json -o kate-rig.glb", [&call, flags] { rig(call, *flags); });
    add_face_flags(*verb, flags->face);
    verb->add_option("-o,--output", flags->output.output, "the rig file to write (.glb)")->required();
    add_skin_flags(*verb, flags->output);
    verb->add_option("--picture", flags->picture, "also draw the points and their influence as a sheet (.png)");
}

}  // namespace mien::cli
