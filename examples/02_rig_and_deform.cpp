// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Open the jaw by hand: a rig, one displacement, one deformed head. usage: 02_rig_and_deform HEAD POINTS OUT.obj

#include <cstdio>
#include <fstream>

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/riggers.hpp"
#include "mien/error.hpp"
#include "mien/io/point_cache.hpp"
#include "mien/io/read.hpp"

int main(int argc, char** argv) try {
    if (argc != 4) return std::fputs("usage: 02_rig_and_deform HEAD POINTS OUT.obj\n", stderr), 2;
    const mien::Face face = mien::read_face(argv[1], argv[2]);
    const mien::Rig rig = mien::make_rig(face, "biharmonic");

    // Feature point 2.1 is the chin: half an eye distance down, the others stay.
    const auto chin = mien::find_point(rig.points, "2.1");
    if (!chin) throw mien::Error("expected the feature point 2.1 on this head");
    std::vector<mien::Vec3f> moved(rig.points.size());
    moved[*chin].y = static_cast<float>(-0.5 * mien::eye_distance(face.points));

    std::vector<mien::Vec3f> positions(vertex_count(rig));
    mien::deform(rig, moved, positions);
    std::ofstream out(argv[3]);
    mien::format_obj(face.mesh, positions, out);
    std::printf("the chin moved by %.3g\n", -moved[*chin].y);
} catch (const mien::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
