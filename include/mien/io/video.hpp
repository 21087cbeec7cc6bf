// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "mien/picture.hpp"

namespace mien {

struct VideoOptions {
    bool overwrite = false;  ///< replace a file that is there
};

/// Writes pictures as the frames of a video that every browser and player shows, by the path's extension: .mp4 (H.264,
/// with its index in front) or .webm (VP9), both 4:2:0 in the colours of BT.709.
///
/// - Frame k, from 0, is shown from k / fps seconds on; WebM rounds to a millisecond.
/// - Both codecs want even sizes: an odd one grows by a copy of its last column or row.
/// - What is not opaque is laid over black.
/// - The same frames give the same bytes, whatever the number of cores.
/// - Until `finish` everything is in a temporary file beside the path, which an unfinished writer takes with it.
///
/// Throws Error at another extension, a size outside 1 to 8192, a rate outside 0.1 to 1000 frames per second, a picture
/// of another size, a video without frames, and (Kind::access) when the file cannot be written.
class VideoWriter {
public:
    VideoWriter(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height, double fps,
                const VideoOptions& options = {});
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;
    ~VideoWriter();

    /// Appends one frame.
    void add(const Picture& frame);

    /// Ends the video and puts it in place; nothing can be added afterwards.
    void finish();

private:
    struct Encoder;
    std::unique_ptr<Encoder> encoder_;
};

}  // namespace mien
