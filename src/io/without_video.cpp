// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What stands in for video.cpp in a build with MIEN_VIDEO=OFF.

#include "mien/error.hpp"
#include "mien/io/video.hpp"

namespace mien {

struct VideoWriter::Encoder {};

VideoWriter::VideoWriter(const std::filesystem::path& path, std::uint32_t, std::uint32_t, double, const VideoOptions&) {
    throw Error(path.string() + ": this build of mien writes no video; expected a folder for frames or a .png");
}
VideoWriter::~VideoWriter() = default;

void VideoWriter::add(const Picture&) {}
void VideoWriter::finish() {}

}  // namespace mien
