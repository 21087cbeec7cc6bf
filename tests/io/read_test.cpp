// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/read.hpp"

#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>
#include <unistd.h>

#include "io/text.hpp"
#include "shapes.hpp"

#include "mien/error.hpp"
#include "mien/io/fap_text.hpp"
#include "mien/io/point_cache.hpp"
#include "mien/io/write.hpp"

namespace mien {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

// A folder of its own for each test, two levels deep so that there is something outside.
class Read : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "mien-read-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        outside_ = name;
        folder_ = outside_ / "head";
        fs::create_directory(folder_);
    }
    void TearDown() override { fs::remove_all(outside_); }

    fs::path file(const fs::path& name, std::string_view content) const {
        write_file(folder_ / name, as_bytes(content), {true, {}});
        return folder_ / name;
    }

    fs::path outside_, folder_;
};

struct Refusal {
    Error::Kind kind = Error::Kind::input;
    std::string sentence = "nothing was thrown";
};

Refusal refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return {error.kind(), error.what()};
    }
    return {};
}

// A triangle as .gltf whose 36 bytes of positions are at `uri`.
std::string gltf(const std::string& uri) {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": ")" +
           uri + "\"}]}";
}

std::string gltf_positions() {
    std::string bytes(36, '\0');
    bytes.replace(12, 4, std::string("\0\0\x80\x3f", 4));
    bytes.replace(28, 4, std::string("\0\0\x80\x3f", 4));
    return bytes;
}

TEST_F(Read, a_file_that_cannot_be_read_is_an_error_of_access_that_names_it) {
    for (const fs::path& path :
         {folder_ / "no.obj", folder_ / "no" / "a.obj", folder_ / (std::string(300, 'x') + ".obj")}) {
        const Refusal found = refusal([&] { read_mesh(path); });
        EXPECT_EQ(found.kind, Error::Kind::access);
        EXPECT_THAT(found.sentence, StartsWith(path.string() + ": cannot read: "));
    }
    fs::create_directory(folder_ / "a.trc");
    const Refusal found = refusal([&] { read_take(folder_ / "a.trc"); });
    EXPECT_EQ(found.kind, Error::Kind::access);
    EXPECT_THAT(found.sentence, HasSubstr("it is a folder"));
}

TEST_F(Read, what_a_parser_refuses_is_an_error_of_input_that_names_the_file) {
    const fs::path path = file("a.obj", "v 0 0 nan\n");
    const Refusal found = refusal([&] { read_mesh(path); });
    EXPECT_EQ(found.kind, Error::Kind::input);
    EXPECT_THAT(found.sentence, StartsWith(path.string() + ": obj line 1: expected a finite z"));
    const Mesh mesh = read_mesh(file("a.obj", triangle));
    const fs::path points = file("points", "{\"2.1\": 3}");
    EXPECT_THAT(refusal([&] { read_points(points, mesh); }).sentence, StartsWith(points.string() + ": points /2.1: "));
}

TEST_F(Read, an_unknown_extension_is_refused_before_the_file_is_opened) {
    for (const char* name : {"a.blend", "a", "a.trc", ".obj"}) {
        const Refusal found = refusal([&] { read_mesh(folder_ / name); });
        EXPECT_EQ(found.kind, Error::Kind::input) << name;
        EXPECT_THAT(found.sentence, HasSubstr("expected a file that ends in .glb, .gltf, .fbx, .obj, .off or .ply"));
    }
    EXPECT_THAT(refusal([&] { read_take(folder_ / "a.obj"); }).sentence, HasSubstr(".trc, .csv or .c3d"));
    EXPECT_THAT(refusal([&] { read_marker_map(folder_ / "a.txt"); }).sentence, HasSubstr(".csv or .json"));
    EXPECT_THAT(refusal([&] { read_rig(folder_ / "a.gltf"); }).sentence, HasSubstr(".glb"));
}

TEST_F(Read, a_mesh_all_of_whose_faces_lie_on_a_point_or_a_line_is_refused) {
    const std::string line = "v 0 0 0\nv 1 1 1\nv 2 2 2\nv 3 3 3\n";
    const std::string faces = "f 1 2 3\nf 2 3 4\nf 1 1 1\nf 1 2 3 4\n";
    EXPECT_THAT(refusal([&] { read_mesh(file("a.obj", line + faces)); }).sentence, HasSubstr("no area"));
    EXPECT_EQ(face_count(read_mesh(file("a.obj", line + "v 0 1 0\n" + faces + "f 1 2 5\n"))), 5U);
}

TEST_F(Read, every_mesh_format_is_chosen_by_its_extension_in_either_case) {
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (const fs::path& path : {file("a.OBJ", triangle), file("a.off", off), file("a.Ply", ply)})
        EXPECT_EQ(read_mesh(path).positions, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << path;
}

TEST_F(Read, files_longer_than_one_chunk_are_read_whole) {
    const std::string comment = "#" + std::string((std::size_t{1} << 20) - 2, ' ') + "\n";
    EXPECT_EQ(face_count(read_mesh(file("a.obj", comment + triangle))), 1U);
    EXPECT_EQ(face_count(read_mesh(file("a.obj", triangle + comment + comment + "f 3 2 1\n"))), 2U);
}

TEST_F(Read, takes_faces_and_marker_maps_are_what_was_written) {
    const Take take{{"2.1"}, {0, 0.5}, {{1, 2, 3}, {4, 5, 6}}, {}, "mm"};
    write(take, folder_ / "a.trc");
    write(take, folder_ / "a.csv");
    for (const char* name : {"a.trc", "a.csv"}) EXPECT_EQ(read_take(folder_ / name).samples, take.samples) << name;
    const Face face = read_face(file("a.obj", triangle), file("a.json", "{\"2.1\": 2}"));
    EXPECT_EQ(face.points.at(0).position, (Vec3{0, 1, 0}));
    EXPECT_EQ(vertex_count(face.mesh), 3U);
    EXPECT_EQ(read_marker_map(file("m.CSV", "chin,2.1\n")).at(0).to, "2.1");
}

TEST_F(Read, parameters_are_read_as_text_or_stream_by_their_extension) {
    FapStream stream;
    stream.frames.emplace_back().mask.set(2);
    stream.frames[0].value[2] = 40;
    const auto text = file("a.FAP", format_fap_text(stream)), bits = file("a.fba", format_fba(stream).bytes);
    EXPECT_EQ(read_faps(text).stream.frames, stream.frames);
    EXPECT_EQ(read_faps(bits).stream.frames, stream.frames);
    EXPECT_THROW(read_faps(file("a.txt", "2.1 a 25 0")), Error);
}

TEST_F(Read, a_head_is_read_without_a_picture_that_is_not_there) {
    file("a.bin", gltf_positions());
    std::string text = gltf("a.bin");
    text.insert(text.rfind('}'), R"(, "images": [{"uri": "skin.png"}], "textures": [{"source": 0}])");
    const Mesh mesh = read_mesh(file("a.gltf", text));
    EXPECT_EQ(vertex_count(mesh), 3U);
    ASSERT_EQ(mesh.left_out.size(), 1U);
    EXPECT_THAT(mesh.left_out[0], HasSubstr("skin.png"));
    file("skin.png", "any bytes");
    EXPECT_TRUE(read_mesh(file("a.gltf", text)).left_out.empty());
}

TEST_F(Read, a_scene_is_read_by_the_extension_of_its_file) {
    file("a.bin", gltf_positions());
    EXPECT_EQ(read_scene(file("a.gltf", gltf("a.bin"))).surfaces.at(0).positions.at(1), (Vec3f{1, 0, 0}));
    const Scene scene = read_scene(file("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    EXPECT_EQ(scene.surfaces.at(0).positions.at(1), (Vec3f{1, 0, 0}));
    EXPECT_THAT(refusal([&] { read_scene(folder_ / "a.txt"); }).sentence, HasSubstr("expected a file that ends in"));
    EXPECT_THAT(refusal([&] { read_scene(file("b.gltf", gltf("gone.bin"))); }).sentence, HasSubstr("b.gltf: "));
}

TEST_F(Read, a_gltf_reaches_files_of_its_folder_and_below_and_nothing_else) {
    fs::create_directory(folder_ / "below");
    file("a.bin", gltf_positions());
    file("below/a.bin", gltf_positions());
    write_file(outside_ / "secret.bin", as_bytes(gltf_positions()));
    fs::create_symlink(outside_ / "secret.bin", folder_ / "link.bin");
    for (const char* uri : {"a.bin", "below/a.bin", "below/../a.bin"})
        EXPECT_EQ(read_mesh(file("a.gltf", gltf(uri))).positions.at(1), (Vec3f{1, 0, 0})) << uri;
    for (const std::string& uri :
         {std::string("../secret.bin"), (outside_ / "secret.bin").string(), std::string("link.bin"),
          std::string("below/../../secret.bin"), std::string("below"), std::string("%2e%2e/secret.bin"),
          std::string("no.bin"), std::string("."), std::string("file:///etc/passwd")}) {
        const Refusal found = refusal([&] { read_mesh(file("a.gltf", gltf(uri))); });
        EXPECT_THAT(found.sentence, AnyOf(HasSubstr("expected a file"), HasSubstr("expected a relative uri"))) << uri;
    }
}

// A square that grows by a tenth a row, 25 rows a second.
MeshSequence growing_square(std::size_t rows) {
    MeshSequence sequence{shapes::strip(1), {}, {}};
    for (std::size_t row = 0; row < rows; ++row) sequence.times.push_back(static_cast<double>(row) / 25);
    sequence.positions = [rest = sequence.mesh.positions](std::size_t row, std::span<Vec3f> positions) {
        for (std::size_t v = 0; v < positions.size(); ++v)
            positions[v] = (1 + 0.1F * static_cast<float>(row)) * rest[v];
    };
    return sequence;
}

void expect_equal(const MeshSequence& a, const MeshSequence& b) {
    EXPECT_THAT(a.times, testing::Pointwise(testing::DoubleNear(1e-6), b.times));
    ASSERT_EQ(a.times.size(), b.times.size());
    for (std::size_t row = 0; row < a.times.size(); ++row) {
        std::vector<Vec3f> p(vertex_count(a.mesh)), q(vertex_count(b.mesh));
        a.positions(row, p);
        b.positions(row, q);
        EXPECT_EQ(p, q) << "row " << row;
    }
}

TEST_F(Read, caches_and_folders_of_frames_read_back_as_they_were_written) {
    const MeshSequence sequence = growing_square(12);
    std::ostringstream head;
    format_obj(sequence.mesh, sequence.mesh.positions, head);
    const fs::path neutral = file("head.obj", head.str());
    for (const char* name : {"baked.mdd", "baked.PC2", "frames"}) {
        write(sequence, folder_ / name);
        const MeshSequence again = read_sequence(folder_ / name, {neutral, 25, ""});
        EXPECT_EQ(again.mesh.face_vertices, sequence.mesh.face_vertices);
        expect_equal(again, sequence);
    }
    expect_equal(read_sequence(folder_ / "baked.mdd", {neutral, 0, ""}), sequence);
}

TEST_F(Read, frames_of_a_folder_come_in_the_order_of_their_numbers) {
    const fs::path frames = folder_ / "frames";
    fs::create_directory(frames);
    const auto frame = [&](const std::string& name, const std::string& x) {
        file(fs::path("frames") / name, "v 0 0 " + x + "\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    };
    frame("smile10.obj", "10");
    frame("smile9.obj", "9");
    frame("smile009.OBJ", "8");
    frame("smile011.obj", "11");
    file("frames/notes.txt", "none of them");
    const MeshSequence sequence = read_sequence(frames, {{}, 10, ""});
    std::vector<float> order;
    for (std::size_t row = 0; row < sequence.times.size(); ++row) {
        std::vector<Vec3f> positions(3);
        sequence.positions(row, positions);
        order.push_back(positions[0].z);
    }
    EXPECT_THAT(order, testing::ElementsAre(8, 9, 10, 11));
    EXPECT_DOUBLE_EQ(sequence.times[3], 0.3);
}

TEST_F(Read, a_frame_of_another_topology_is_named) {
    fs::create_directory(folder_ / "frames");
    file("frames/1.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\n");
    const auto refused = [&](const std::string& second) {
        const fs::path frame = file("frames/2.obj", second);
        const std::string sentence = refusal([&] { read_sequence(folder_ / "frames", {{}, 25, ""}); }).sentence;
        EXPECT_THAT(sentence, StartsWith(frame.string()));
        return sentence.substr(std::min(sentence.size(), frame.string().size()));
    };
    EXPECT_EQ(refused(triangle), ": expected 4 vertices as in 1.obj, found 3");
    EXPECT_EQ(refused("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3 4\n"),
              ": expected 1 faces as in 1.obj, found 2");
    EXPECT_EQ(refused("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4\n"),
              ": expected face 0 to have the corners it has in 1.obj, found others");
    EXPECT_THAT(refused("v 0 0 x\n"), HasSubstr("line 1"));
}

TEST_F(Read, a_sequence_without_what_it_needs_is_refused_with_its_name) {
    fs::create_directory(folder_ / "empty");
    fs::create_directory(folder_ / "frames");
    file("frames/1.obj", triangle);
    const fs::path cache = file("a.mdd", "1234567"), head = file("head.obj", triangle),
                   glb = file("a.gltf", gltf("a.bin"));
    file("a.bin", gltf_positions());
    const auto refused = [&](const fs::path& path, const SequenceOptions& options) {
        const Refusal found = refusal([&] { read_sequence(path, options); });
        EXPECT_THAT(found.sentence, StartsWith(path.string()));
        EXPECT_EQ(found.kind, Error::Kind::input);
        return found.sentence;
    };
    EXPECT_THAT(refused(folder_ / "empty", {{}, 25, ""}),
                HasSubstr("OBJ or PLY files in the folder, one a row, found none"));
    EXPECT_THAT(refused(folder_ / "frames", {}), HasSubstr("expected the rows per second to be given"));
    EXPECT_THAT(refused(cache, {}), HasSubstr("expected the head they belong to, found none"));
    EXPECT_THAT(refused(cache, {head, 0, ""}), HasSubstr("mdd byte 7"));
    EXPECT_THAT(refused(glb, {}), HasSubstr("expected an animation, found none"));
    EXPECT_THAT(refused(head, {}), HasSubstr("expected a file that ends in"));
    EXPECT_THAT(read_animations(glb), testing::IsEmpty());
    EXPECT_EQ(refusal([&] { read_sequence(folder_ / "none.glb"); }).kind, Error::Kind::access);
}

}  // namespace
}  // namespace mien
