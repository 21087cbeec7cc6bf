// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/write.hpp"

#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <stdexcept>
#include <sys/resource.h>
#include <unistd.h>

#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {
namespace {

namespace fs = std::filesystem;

// A folder of its own for each test.
class Write : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "mien-write-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }

    [[nodiscard]] std::size_t entries() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }
    static std::string content(const fs::path& path) {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    fs::path folder_;
};

MeshSequence sequence(std::size_t rows) {
    MeshSequence result;
    result.mesh.positions.resize(3);
    add_face(result.mesh, std::vector<std::uint32_t>{0, 1, 2});
    result.times.resize(rows);
    result.positions = [](std::size_t, std::span<Vec3f> positions) { positions[1] = {1, 0, 0}; };
    return result;
}

MeshSequence broken() {
    MeshSequence result = sequence(3);
    result.positions = [](std::size_t row, std::span<Vec3f>) {
        if (row == 1) throw std::runtime_error("row 1");
    };
    return result;
}

Error::Kind kind_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.kind();
    }
    ADD_FAILURE() << "expected Error";
    return Error::Kind::input;
}

TEST_F(Write, an_existing_file_is_kept_unless_overwriting_is_asked_for) {
    const fs::path path = folder_ / "a.bin";
    write_file(path, as_bytes("old"));
    EXPECT_EQ(kind_of([&] { write_file(path, as_bytes("new")); }), Error::Kind::access);
    EXPECT_EQ(content(path), "old");
    write_file(path, as_bytes("new"), {true, {}});
    EXPECT_EQ(content(path), "new");
    EXPECT_EQ(entries(), 1U);
}

TEST_F(Write, an_error_on_the_way_leaves_nothing_or_the_old_file) {
    const fs::path path = folder_ / "a.mdd";
    EXPECT_THROW(write(broken(), path), std::runtime_error);
    EXPECT_EQ(entries(), 0U);
    write_file(path, as_bytes("old"));
    EXPECT_THROW(write(broken(), path, {true, {}}), std::runtime_error);
    EXPECT_EQ(content(path), "old");
    EXPECT_THROW(write(broken(), folder_ / "frames"), std::runtime_error);
    EXPECT_EQ(entries(), 1U);
}

TEST_F(Write, places_that_cannot_be_written_are_errors_of_access) {
    EXPECT_EQ(kind_of([&] { write_file(folder_ / "no" / "a.bin", as_bytes("x")); }), Error::Kind::access);
    EXPECT_EQ(kind_of([&] { write_file(folder_, as_bytes("x"), {true, {}}); }), Error::Kind::access);
    EXPECT_EQ(kind_of([&] { write_file(folder_ / std::string(300, 'x'), as_bytes("x")); }), Error::Kind::access);
    EXPECT_EQ(kind_of([&] { write(sequence(1), folder_ / std::string(300, 'x')); }), Error::Kind::access);
    EXPECT_EQ(entries(), 0U);
}

// Somebody other than root while this lives: root may write to a read-only folder.
class Ordinary {
public:
    explicit Ordinary(const fs::path& folder) {
        constexpr uid_t nobody = 65534;
        if (geteuid() == 0) there = chown(folder.c_str(), nobody, nobody) == 0 && seteuid(nobody) == 0;
    }
    Ordinary(const Ordinary&) = delete;
    Ordinary& operator=(const Ordinary&) = delete;
    ~Ordinary() { EXPECT_EQ(seteuid(getuid()), 0); }
    bool there = true;
};

TEST_F(Write, a_read_only_folder_is_an_error_of_access_and_stays_as_it_was) {
    write(sequence(2), folder_ / "frames");
    write_file(folder_ / "a.bin", as_bytes("old"));
    fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
    {
        const Ordinary user(folder_);
        if (!user.there) GTEST_SKIP() << "root cannot become another user here";
        EXPECT_EQ(kind_of([&] { write_file(folder_ / "b.bin", as_bytes("x")); }), Error::Kind::access);
        EXPECT_EQ(kind_of([&] { write_file(folder_ / "a.bin", as_bytes("x"), {true, {}}); }), Error::Kind::access);
        EXPECT_EQ(kind_of([&] { write(sequence(1), folder_ / "more"); }), Error::Kind::access);
        EXPECT_EQ(kind_of([&] { write(sequence(1), folder_ / "frames", {true, {}}); }), Error::Kind::access);
    }
    fs::permissions(folder_, fs::perms::owner_all);
    EXPECT_EQ(entries(), 2U);
    EXPECT_EQ(content(folder_ / "a.bin"), "old");
    EXPECT_TRUE(fs::exists(folder_ / "frames" / "frame_000002.obj"));
}

// A disk that is full after `most` bytes.
class FullDisk {
public:
    explicit FullDisk(rlim_t most) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{most, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;
    ~FullDisk() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, signal_);
    }

private:
    rlimit before_{};
    void (*signal_)(int);
};

TEST_F(Write, a_disk_that_fills_up_leaves_nothing_or_the_old_file) {
    const fs::path path = folder_ / "a.bin";
    const std::string large(100000, 'x');
    write_file(path, as_bytes("old"));
    {
        const FullDisk disk(5000);
        EXPECT_EQ(kind_of([&] { write_file(path, as_bytes(large), {true, {}}); }), Error::Kind::access);
        EXPECT_EQ(kind_of([&] { write(sequence(1000), folder_ / "a.mdd"); }), Error::Kind::access);
    }
    EXPECT_EQ(content(path), "old");
    EXPECT_EQ(entries(), 1U);
}

TEST_F(Write, the_extension_chooses_the_format_and_others_are_refused) {
    const Take take{{"a"}, {0}, {{1, 2, 3}}, {}, "mm"};
    write(take, folder_ / "a.CSV");
    write(take, folder_ / "a.trc");
    write(sequence(2), folder_ / "a.pc2");
    EXPECT_EQ(content(folder_ / "a.CSV"), "time,a.x,a.y,a.z\n0,1,2,3\n");
    EXPECT_TRUE(content(folder_ / "a.trc").starts_with("PathFileType"));
    EXPECT_TRUE(content(folder_ / "a.pc2").starts_with("POINTCACHE2"));
    EXPECT_EQ(kind_of([&] { write(take, folder_ / "a.mdd"); }), Error::Kind::input);
    EXPECT_EQ(kind_of([&] { write(sequence(2), folder_ / "a.trk"); }), Error::Kind::input);
    EXPECT_EQ(entries(), 3U);
}

TEST_F(Write, a_folder_holds_one_obj_a_row_and_tells_its_progress) {
    std::vector<std::size_t> told;
    write(sequence(2), folder_ / "frames", {false, [&](std::size_t done, std::size_t all) { told = {done, all}; }});
    EXPECT_EQ(told, (std::vector<std::size_t>{2, 2}));
    EXPECT_THAT(content(folder_ / "frames" / "frame_000002.obj"), testing::HasSubstr("v 1 0 0\n"));
    EXPECT_EQ(entries(), 1U);
}

TEST_F(Write, only_a_folder_of_frames_is_replaced) {
    const fs::path frames = folder_ / "frames";
    write(sequence(3), frames);
    EXPECT_EQ(kind_of([&] { write(sequence(1), frames); }), Error::Kind::access);
    write(sequence(1), frames, {true, {}});
    EXPECT_FALSE(fs::exists(frames / "frame_000002.obj"));
    write_file(frames / "letter.txt", as_bytes("x"));
    EXPECT_EQ(kind_of([&] { write(sequence(1), frames, {true, {}}); }), Error::Kind::access);
    EXPECT_EQ(content(frames / "letter.txt"), "x");
    fs::remove(frames / "letter.txt");
    write_file(frames / "frame_holiday.obj", as_bytes("x"));
    EXPECT_EQ(kind_of([&] { write(sequence(1), frames, {true, {}}); }), Error::Kind::access);
    fs::remove(frames / "frame_holiday.obj");
    fs::create_directory(frames / "frame_000009.obj");
    EXPECT_EQ(kind_of([&] { write(sequence(1), frames, {true, {}}); }), Error::Kind::access);
    write_file(folder_ / "file", as_bytes("x"));
    EXPECT_EQ(kind_of([&] { write(sequence(1), folder_ / "file", {true, {}}); }), Error::Kind::access);
    EXPECT_EQ(content(folder_ / "file"), "x");
    EXPECT_EQ(entries(), 2U);
}

const std::vector<NamedFile> two_files{{"a.txt", "one"}, {"b.bin", std::string("t\0o", 3)}};

TEST_F(Write, a_folder_of_named_files_holds_their_bytes_and_nothing_else) {
    write_folder(two_files, folder_ / "made");
    EXPECT_EQ(content(folder_ / "made/a.txt"), "one");
    EXPECT_EQ(content(folder_ / "made/b.bin"), std::string("t\0o", 3));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "made"), fs::directory_iterator()), 2);
    EXPECT_EQ(entries(), 1U);
}

TEST_F(Write, only_a_folder_of_the_same_names_is_replaced) {
    write_folder(two_files, folder_ / "made");
    EXPECT_EQ(kind_of([&] { write_folder(two_files, folder_ / "made"); }), Error::Kind::access);
    WriteOptions options;
    options.overwrite = true;
    write_folder(std::vector<NamedFile>{{"a.txt", "new"}, {"b.bin", ""}}, folder_ / "made", options);
    EXPECT_EQ(content(folder_ / "made/a.txt"), "new");
    write_file(folder_ / "made/letter", {}, {});
    EXPECT_EQ(kind_of([&] { write_folder(two_files, folder_ / "made", options); }), Error::Kind::access);
    EXPECT_EQ(content(folder_ / "made/a.txt"), "new");
    write_file(folder_ / "file", {}, {});
    EXPECT_EQ(kind_of([&] { write_folder(two_files, folder_ / "file", options); }), Error::Kind::access);
    EXPECT_EQ(entries(), 2U) << "nothing is left beside them";
}

}  // namespace
}  // namespace mien
