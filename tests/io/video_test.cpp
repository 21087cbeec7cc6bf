// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/video.hpp"

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <sys/resource.h>
#include <vector>

#include "mien/error.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace mien {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Property;

// Half red over blue by frame, with a green square that steps to the right.
Picture frame(std::uint32_t width, std::uint32_t height, std::uint32_t k) {
    Picture picture{width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height, 255)};
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            std::uint8_t* pixel = &picture.rgba[std::size_t{4} * (y * width + x)];
            const bool square = y < 16 && x >= 8 * k && x < 8 * k + 16;
            pixel[0] = !square && y < height / 2 ? 200 : 20;
            pixel[1] = square ? 180 : 20;
            pixel[2] = !square && y >= height / 2 ? 200 : 20;
        }
    return picture;
}

// What a player gets out of a file: luma and chroma of every frame, and when it is shown.
struct Played {
    int width = 0, height = 0;
    double rate = 0;
    bool bt709 = true;
    std::vector<double> times;
    std::vector<std::vector<std::uint8_t>> y, u, v;  // rows without padding
};

std::vector<std::uint8_t> plane(const AVFrame& frame, int index, int width, int height) {
    std::vector<std::uint8_t> bytes;
    for (int row = 0; row < height; ++row) {
        const std::uint8_t* from = frame.data[index] + static_cast<std::ptrdiff_t>(row) * frame.linesize[index];
        bytes.insert(bytes.end(), from, from + width);
    }
    return bytes;
}

void take_frames(AVCodecContext& codec, AVFrame& frame, double unit, Played& played) {
    while (avcodec_receive_frame(&codec, &frame) == 0) {
        const int w = frame.width, h = frame.height;
        played.times.push_back(static_cast<double>(frame.best_effort_timestamp) * unit);
        played.bt709 = played.bt709 && frame.colorspace == AVCOL_SPC_BT709 && frame.color_range == AVCOL_RANGE_MPEG;
        played.y.push_back(plane(frame, 0, w, h));
        played.u.push_back(plane(frame, 1, w / 2, h / 2));
        played.v.push_back(plane(frame, 2, w / 2, h / 2));
    }
}

Played play(const fs::path& path) {
    Played played;
    AVFormatContext* file = nullptr;
    if (avformat_open_input(&file, path.c_str(), nullptr, nullptr) < 0 ||
        avformat_find_stream_info(file, nullptr) < 0) {
        ADD_FAILURE() << "no video: " << path;
        return played;
    }
    const AVStream& stream = *file->streams[0];
    AVCodecContext* codec = avcodec_alloc_context3(avcodec_find_decoder(stream.codecpar->codec_id));
    avcodec_parameters_to_context(codec, stream.codecpar);
    avcodec_open2(codec, codec->codec, nullptr);
    played.width = stream.codecpar->width;
    played.height = stream.codecpar->height;
    played.rate = av_q2d(stream.avg_frame_rate);
    AVPacket* packet = av_packet_alloc();
    AVFrame* picture = av_frame_alloc();
    const double unit = av_q2d(stream.time_base);
    while (av_read_frame(file, packet) == 0) {
        avcodec_send_packet(codec, packet);
        av_packet_unref(packet);
        take_frames(*codec, *picture, unit, played);
    }
    avcodec_send_packet(codec, nullptr);
    take_frames(*codec, *picture, unit, played);
    av_frame_free(&picture);
    av_packet_free(&packet);
    avcodec_free_context(&codec);
    avformat_close_input(&file);
    return played;
}

struct Yuv {
    double y, u, v;
};

// BT.709, limited range (ITU-R BT.709-6, items 3.2 to 3.4), of gamma-coded red, green and blue from 0 to 255.
Yuv bt709(double r, double g, double b) {
    const double luma = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    return {16 + 219 * luma / 255, 128 + 224 * (b - luma) / 1.8556 / 255, 128 + 224 * (r - luma) / 1.5748 / 255};
}

// The mean distance of a frame from the picture it was made of, over luma and chroma, in steps of 8 bits.
double mean_error(const Played& played, std::size_t k, const Picture& picture) {
    double sum = 0;
    const auto distance = [&](std::uint32_t x, std::uint32_t y) {
        const std::uint8_t* p = &picture.rgba[std::size_t{4} * (y * picture.width + x)];
        const Yuv expected = bt709(p[0], p[1], p[2]);
        const std::size_t at = std::size_t{y} * played.width + x,
                          half = std::size_t{y / 2} * (played.width / 2) + x / 2;
        return std::abs(played.y[k][at] - expected.y) + std::abs(played.u[k][half] - expected.u) +
               std::abs(played.v[k][half] - expected.v);
    };
    for (std::uint32_t y = 0; y < picture.height; ++y)
        for (std::uint32_t x = 0; x < picture.width; ++x) sum += distance(x, y) / 3;
    return sum / picture.width / picture.height;
}

// A folder of its own for each test, once for each kind of video.
class Video : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "mien-video-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }

    [[nodiscard]] fs::path path(const std::string& stem = "film") const { return folder_ / (stem + GetParam()); }
    [[nodiscard]] std::size_t entries() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }
    static std::string content(const fs::path& file) {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    static void write(const fs::path& file, std::uint32_t width, std::uint32_t height, std::uint32_t frames,
                      double fps = 25) {
        VideoWriter writer(file, width, height, fps);
        for (std::uint32_t k = 0; k < frames; ++k) writer.add(frame(width, height, k));
        writer.finish();
    }

    fs::path folder_;
};

INSTANTIATE_TEST_SUITE_P(Formats, Video, testing::Values(".mp4", ".webm"),
                         [](const auto& test) { return std::string(test.param).substr(1); });

TEST_P(Video, plays_as_many_frames_of_the_size_and_rate_that_were_added) {
    write(path(), 160, 96, 12, 29.97);
    const Played played = play(path());
    EXPECT_EQ(played.width, 160);
    EXPECT_EQ(played.height, 96);
    EXPECT_NEAR(played.rate, 29.97, 0.01);
    ASSERT_EQ(played.times.size(), 12U);
    for (std::size_t k = 0; k < 12; ++k) EXPECT_NEAR(played.times[k], static_cast<double>(k) / 29.97, 0.0006);
}

TEST_P(Video, shows_each_frame_in_its_colours_by_bt709) {
    write(path(), 160, 96, 12);
    const Played played = play(path());
    ASSERT_EQ(played.y.size(), 12U);
    EXPECT_TRUE(played.bt709);
    for (std::uint32_t k = 0; k < 12; ++k) {
        EXPECT_LT(mean_error(played, k, frame(160, 96, k)), 2) << k;
        EXPECT_GT(mean_error(played, k, frame(160, 96, (k + 6) % 12)), 2) << k;
    }
}

TEST_P(Video, grows_odd_sizes_to_even_ones_by_their_last_column_and_row) {
    write(path(), 161, 95, 2);
    const Played played = play(path());
    ASSERT_EQ(played.y.size(), 2U);
    ASSERT_EQ(played.width, 162);
    ASSERT_EQ(played.height, 96);
    const std::vector<std::uint8_t>& y = played.y[1];
    EXPECT_NEAR(y[162 * 30 + 161], y[162 * 30 + 159], 6);
    EXPECT_NEAR(y[162 * 95 + 80], y[162 * 93 + 80], 6);
}

TEST_P(Video, lays_what_is_not_opaque_over_black) {
    Picture half{32, 32, std::vector<std::uint8_t>(4096, 200)};
    for (std::size_t i = 3; i < half.rgba.size(); i += 4) half.rgba[i] = 128;
    VideoWriter writer(path(), 32, 32, 25);
    writer.add(half);
    writer.finish();
    EXPECT_NEAR(play(path()).y.at(0).at(500), 16 + 219 * (200 * 128 / 255.0) / 255, 3);
}

TEST_P(Video, is_the_same_bytes_twice) {
    write(path("a"), 320, 180, 40);
    write(path("b"), 320, 180, 40);
    EXPECT_EQ(content(path("a")), content(path("b")));
}

TEST_P(Video, leaves_nothing_behind_when_it_is_not_finished) {
    {
        VideoWriter writer(path(), 64, 64, 25);
        for (std::uint32_t k = 0; k < 5; ++k) writer.add(frame(64, 64, k));
        EXPECT_EQ(entries(), 1U);
        EXPECT_FALSE(fs::exists(path()));
    }
    EXPECT_EQ(entries(), 0U);
}

TEST_P(Video, keeps_the_old_file_until_the_new_one_is_whole) {
    std::ofstream(path()) << "old";
    EXPECT_THROW(VideoWriter(path(), 64, 64, 25), Error);
    VideoWriter writer(path(), 64, 64, 25, {.overwrite = true});
    writer.add(frame(64, 64, 0));
    EXPECT_EQ(content(path()), "old");
    writer.finish();
    EXPECT_EQ(play(path()).y.size(), 1U);
    EXPECT_EQ(entries(), 1U);
}

TEST_P(Video, refuses_sizes_rates_and_pictures_that_cannot_be) {
    EXPECT_THAT([&] { VideoWriter(path(), 0, 64, 25); }, testing::ThrowsMessage<Error>(HasSubstr("found 0 x 64")));
    EXPECT_THROW(VideoWriter(path(), 64, 8193, 25), Error);
    EXPECT_THROW(VideoWriter(path(), 64, 64, 0), Error);
    EXPECT_THROW(VideoWriter(path(), 64, 64, std::nan("")), Error);
    VideoWriter writer(path(), 64, 64, 25);
    EXPECT_THAT([&] { writer.add(frame(64, 62, 0)); },
                testing::ThrowsMessage<Error>(HasSubstr("video frame 0: expected 64 x 64")));
    EXPECT_THROW(writer.add({64, 64, {}}), Error);
    EXPECT_THAT([&] { writer.finish(); }, testing::ThrowsMessage<Error>(HasSubstr("at least one frame")));
    EXPECT_THROW(writer.add(frame(64, 64, 0)), Error);
    EXPECT_THROW(writer.finish(), Error);
    EXPECT_EQ(entries(), 0U);
}

TEST_P(Video, says_where_it_cannot_write) {
    const fs::path nowhere = folder_ / "none" / "film" += GetParam();
    EXPECT_THAT([&] { VideoWriter(nowhere, 64, 64, 25); },
                testing::Throws<Error>(testing::AllOf(Property(&Error::kind, Error::Kind::access),
                                                      Property(&Error::what, HasSubstr("No such file")))));
}

// The limit on the size of a file stands for a full disk; the child keeps it to itself.
TEST_P(Video, says_so_when_the_disk_is_full_and_leaves_nothing_behind) {
    const auto fill = [&] {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{2000, 2000};
        setrlimit(RLIMIT_FSIZE, &limit);
        try {
            write(path(), 160, 96, 40);
        } catch (const Error& error) {
            std::exit(error.kind() == Error::Kind::access &&
                              std::string(error.what()).find("File too large") != std::string::npos
                          ? 0
                          : 1);
        }
        std::exit(2);
    };
    EXPECT_EXIT(fill(), testing::ExitedWithCode(0), "");
    EXPECT_EQ(entries(), 0U);
}

TEST(VideoFormats, names_the_ones_it_knows) {
    EXPECT_THAT([] { VideoWriter("film.avi", 64, 64, 25); },
                testing::ThrowsMessage<Error>(HasSubstr("ends in .mp4 or .webm, found '.avi'")));
}

TEST(VideoFormats, puts_the_index_of_an_mp4_in_front) {
    std::string name = (fs::temp_directory_path() / "mien-video-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    const fs::path file = fs::path(name) / "a:b.MP4";
    VideoWriter writer(file, 64, 64, 25);
    writer.add(frame(64, 64, 0));
    writer.finish();
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));
    fs::remove_all(name);
}

}  // namespace
}  // namespace mien
