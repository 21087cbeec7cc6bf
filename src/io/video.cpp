// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Video through FFmpeg's libraries: libavformat holds the file, libavcodec calls x264 or libvpx, libswscale turns
// colours into 4:2:0. What would differ from run to run is fixed: "bitexact" keeps versions and random track numbers
// out of the file, the number of threads is ours and not the machine's (x264's rate control depends on it), and x264 is
// told to choose the same methods on every processor.
//
// VP9 runs in libvpx's realtime mode at cpu-used 7, which keeps up with H.264: over 300 frames of 640x480 a second on
// one core of 2020's servers. The "good" mode that libvpx begins with takes six times as long.

#include "mien/io/video.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>
#include <string>
#include <utility>

#include "io/temporary.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/error.h>
#include <libavutil/imgutils.h>
#include <libavutil/log.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

namespace mien {

namespace {

namespace fs = std::filesystem;

constexpr int threads = 4;
constexpr std::uint32_t largest_side = 8192;

struct Format {
    std::string_view extension;
    const char *muxer, *codec;
    std::initializer_list<std::pair<const char*, const char*>> codec_settings, muxer_settings;
};

const Format& format_of(const fs::path& path) {
    static const Format formats[] = {
        {".mp4",
         "mp4",
         "libx264",
         {{"preset", "veryfast"}, {"crf", "20"}, {"x264-params", "cpu-independent=1"}},
         {{"movflags", "+faststart"}}},
        {".webm",
         "webm",
         "libvpx-vp9",
         {{"deadline", "realtime"}, {"cpu-used", "7"}, {"lag-in-frames", "0"}, {"crf", "24"}, {"tile-columns", "1"}},
         {}},
    };
    const std::string extension = path.extension().string();
    for (const Format& format : formats)
        if (equal_but_case(extension, format.extension)) return format;
    throw Error(
        fmt::format("{}: expected a video that ends in .mp4 or .webm, found {}", path.string(), shown(extension)));
}

void check_size_and_rate(std::uint32_t width, std::uint32_t height, double fps) {
    if (width < 1 || height < 1 || width > largest_side || height > largest_side)
        throw Error(fmt::format("video: expected a width and height from 1 to {} pixels, found {} x {}", largest_side,
                                width, height));
    if (!(fps >= 0.1 && fps <= 1000))
        throw Error(fmt::format("video: expected a rate from 0.1 to 1000 frames per second, found {}", fps));
}

constexpr int even(std::uint32_t size) {
    return static_cast<int>(size + size % 2);
}

template <auto Free>
struct FreeBy {
    template <class T>
    void operator()(T* thing) const {
        Free(&thing);
    }
};

void close_output(AVFormatContext** output) {
    avio_closep(&(*output)->pb);
    avformat_free_context(*output);
}

void free_scaler(SwsContext** scaler) {
    sws_freeContext(*scaler);
}

using Output = std::unique_ptr<AVFormatContext, FreeBy<close_output>>;
using Codec = std::unique_ptr<AVCodecContext, FreeBy<avcodec_free_context>>;
using Frame = std::unique_ptr<AVFrame, FreeBy<av_frame_free>>;
using Packet = std::unique_ptr<AVPacket, FreeBy<av_packet_free>>;
using Scaler = std::unique_ptr<SwsContext, FreeBy<free_scaler>>;

Frame make_frame(AVPixelFormat format, int width, int height) {
    Frame frame(av_frame_alloc());
    if (!frame) throw std::bad_alloc();
    frame->format = format;
    frame->width = width;
    frame->height = height;
    if (av_frame_get_buffer(frame.get(), 0) < 0) throw std::bad_alloc();
    return frame;
}

Scaler make_scaler(int width, int height) {
    Scaler scaler(sws_getContext(width, height, AV_PIX_FMT_RGB24, width, height, AV_PIX_FMT_YUV420P,
                                 SWS_BILINEAR | SWS_ACCURATE_RND | SWS_BITEXACT | SWS_FULL_CHR_H_INP, nullptr, nullptr,
                                 nullptr));
    if (!scaler) throw std::bad_alloc();
    const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
    sws_setColorspaceDetails(scaler.get(), bt709, 1, bt709, 0, 0, 1 << 16, 1 << 16);
    return scaler;
}

// One row of a picture over black as red, green, blue; columns that the picture lacks repeat its last one.
void copy_row(std::span<const std::uint8_t> rgba, std::span<std::uint8_t> rgb) {
    for (std::size_t x = 0; x < rgb.size() / 3; ++x) {
        const std::uint8_t* pixel = &rgba[4 * std::min(x, rgba.size() / 4 - 1)];
        for (std::size_t c = 0; c < 3; ++c)
            rgb[3 * x + c] = static_cast<std::uint8_t>((pixel[c] * pixel[3] + 127) / 255);
    }
}

}  // namespace

struct VideoWriter::Encoder {
    Encoder(const fs::path& path, std::uint32_t w, std::uint32_t h, double fps, bool overwrite);
    void open_codec(double fps);
    void open_output();
    void encode(const AVFrame* frame);
    // Throws with libav's own words when a call of it failed.
    void check(int code) const;

    fs::path target;
    const Format& format;
    std::uint32_t width, height;
    std::int64_t frames = 0;
    Temporary temporary;  // closed below before it is removed
    Output output;
    Codec codec;
    AVStream* stream = nullptr;
    Frame rgb, yuv;
    Packet packet;
    Scaler scaler;
};

VideoWriter::Encoder::Encoder(const fs::path& path, std::uint32_t w, std::uint32_t h, double fps, bool overwrite)
    : target(path), format(format_of(path)), width(w), height(h), temporary(path, overwrite) {
    check_size_and_rate(width, height, fps);
    refuse_existing(path, overwrite);
    av_log_set_level(AV_LOG_QUIET);  // a library prints nothing, and libav has but one switch for all
    open_codec(fps);
    open_output();
    rgb = make_frame(AV_PIX_FMT_RGB24, codec->width, codec->height);
    yuv = make_frame(AV_PIX_FMT_YUV420P, codec->width, codec->height);
    packet.reset(av_packet_alloc());
    scaler = make_scaler(codec->width, codec->height);
}

void VideoWriter::Encoder::open_codec(double fps) {
    const AVCodec* found = avcodec_find_encoder_by_name(format.codec);
    if (!found) throw Error(fmt::format("{}: this FFmpeg was built without {}", target.string(), format.codec));
    codec.reset(avcodec_alloc_context3(found));
    if (!codec) throw std::bad_alloc();
    codec->width = even(width);
    codec->height = even(height);
    codec->pix_fmt = AV_PIX_FMT_YUV420P;
    codec->framerate = av_d2q(fps, 100000);
    codec->time_base = av_inv_q(codec->framerate);
    codec->gop_size = std::max(1, static_cast<int>(std::lround(2 * fps)));
    codec->thread_count = threads;
    codec->bit_rate = 0;
    codec->color_range = AVCOL_RANGE_MPEG;
    codec->colorspace = AVCOL_SPC_BT709;
    codec->color_primaries = AVCOL_PRI_BT709;
    codec->color_trc = AVCOL_TRC_BT709;
    codec->flags |= AV_CODEC_FLAG_BITEXACT;
    for (const auto& [name, value] : format.codec_settings) check(av_opt_set(codec->priv_data, name, value, 0));
}

void VideoWriter::Encoder::open_output() {
    AVFormatContext* made = nullptr;
    const std::string url = "file:" + temporary.path().string();
    check(avformat_alloc_output_context2(&made, nullptr, format.muxer, url.c_str()));
    output.reset(made);
    output->flags |= AVFMT_FLAG_BITEXACT;
    if (output->oformat->flags & AVFMT_GLOBALHEADER) codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    check(avcodec_open2(codec.get(), nullptr, nullptr));
    stream = avformat_new_stream(output.get(), nullptr);
    if (!stream) throw std::bad_alloc();
    check(avcodec_parameters_from_context(stream->codecpar, codec.get()));
    stream->time_base = codec->time_base;
    stream->avg_frame_rate = codec->framerate;
    for (const auto& [name, value] : format.muxer_settings) check(av_opt_set(output->priv_data, name, value, 0));
    check(avio_open(&output->pb, url.c_str(), AVIO_FLAG_WRITE));
    check(avformat_write_header(output.get(), nullptr));
}

// Hands one frame to the codec, or its end, and writes what comes out.
void VideoWriter::Encoder::encode(const AVFrame* frame) {
    check(avcodec_send_frame(codec.get(), frame));
    for (;;) {
        const int code = avcodec_receive_packet(codec.get(), packet.get());
        if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
        check(code);
        packet->duration = 1;
        av_packet_rescale_ts(packet.get(), codec->time_base, stream->time_base);
        check(av_interleaved_write_frame(output.get(), packet.get()));
    }
}

void VideoWriter::Encoder::check(int code) const {
    if (code >= 0) return;
    char words[AV_ERROR_MAX_STRING_SIZE] = {};
    av_strerror(code, words, sizeof words);
    cannot_write(target, words);
}

VideoWriter::VideoWriter(const fs::path& path, std::uint32_t width, std::uint32_t height, double fps,
                         const VideoOptions& options)
    : encoder_(std::make_unique<Encoder>(path, width, height, fps, options.overwrite)) {}

VideoWriter::~VideoWriter() = default;

void VideoWriter::add(const Picture& frame) {
    if (!encoder_) throw Error("video: a frame was added after its end");
    Encoder& e = *encoder_;
    const std::size_t stride = std::size_t{4} * e.width;
    if (frame.width != e.width || frame.height != e.height || frame.rgba.size() != stride * e.height)
        throw Error(fmt::format("video frame {}: expected {} x {} pixels, found {} x {} in {} bytes", e.frames, e.width,
                                e.height, frame.width, frame.height, frame.rgba.size()));
    e.check(av_frame_make_writable(e.rgb.get()));
    e.check(av_frame_make_writable(e.yuv.get()));
    for (int y = 0; y < e.rgb->height; ++y) {
        const std::size_t from = std::min<std::size_t>(y, e.height - 1);
        copy_row(std::span(frame.rgba).subspan(from * stride, stride),
                 {e.rgb->data[0] + static_cast<std::ptrdiff_t>(y) * e.rgb->linesize[0], std::size_t{3} * e.rgb->width});
    }
    e.check(sws_scale(e.scaler.get(), e.rgb->data, e.rgb->linesize, 0, e.rgb->height, e.yuv->data, e.yuv->linesize));
    e.yuv->pts = e.frames++;
    e.encode(e.yuv.get());
}

void VideoWriter::finish() {
    if (!encoder_) throw Error("video: it was finished before");
    const std::unique_ptr<Encoder> e = std::move(encoder_);
    if (e->frames == 0) throw Error(fmt::format("{}: expected at least one frame, found none", e->target.string()));
    e->encode(nullptr);
    e->check(av_write_trailer(e->output.get()));
    e->check(avio_closep(&e->output->pb));
    synchronize(e->temporary.path(), e->target);
    e->temporary.move_to_target();
}

}  // namespace mien
