// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "render/targets.hpp"

#include <algorithm>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include "mien/error.hpp"

namespace mien {

namespace {

using Kind = GlName::Kind;

GlName picture(GLenum format, GLsizei width, GLsizei height) {
    GlName texture(Kind::texture);
    bind_texture(0, texture.name());
    glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
    return texture;
}

GlName samples(GLenum format, GLsizei width, GLsizei height, GLsizei count) {
    GlName buffer(Kind::renderbuffer);
    glBindRenderbuffer(GL_RENDERBUFFER, buffer.name());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, count, format, width, height);
    return buffer;
}

void attach_samples(GLenum place, const GlName& buffer) {
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, buffer.name());
}
void attach_picture(GLenum place, const GlName& texture) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, place, GL_TEXTURE_2D, texture.name(), 0);
}

GlName framebuffer() {
    GlName name(Kind::framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, name.name());
    return name;
}

void require_complete(const char* what) {
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return;
    forget_gl_errors();
    throw Error(
        fmt::format("render: expected a driver that can draw into {}, found one that cannot ({:#x})", what, status));
}

}  // namespace

Targets::Targets(std::uint32_t width, std::uint32_t height)
    : width_(static_cast<GLsizei>(width)), height_(static_cast<GLsizei>(height)) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
    if (std::max(width, height) > static_cast<std::uint32_t>(most))
        throw Error(
            fmt::format("render: expected a picture of at most {} pixels a side, which is what this driver draws, "
                        "found {} x {}",
                        most, width, height));
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    const GLsizei count = std::min(most, 4);
    draft_ = framebuffer();
    draft_colour_ = samples(GL_RGBA8, width_, height_, count);
    draft_depth_ = samples(GL_DEPTH_COMPONENT24, width_, height_, count);
    attach_samples(GL_COLOR_ATTACHMENT0, draft_colour_);
    attach_samples(GL_DEPTH_ATTACHMENT, draft_depth_);
    require_complete("four samples a pixel");
    done_ = framebuffer();
    done_colour_ = samples(GL_RGBA8, width_, height_, 0);
    attach_samples(GL_COLOR_ATTACHMENT0, done_colour_);
    require_complete("pictures");
    check_gl("a picture");
}

void Targets::make_full() {
    shadow_map_ = picture(GL_DEPTH_COMPONENT24, shadow_size, shadow_size);
    shadow_ = framebuffer();
    attach_picture(GL_DEPTH_ATTACHMENT, shadow_map_);
    require_complete("shadow maps");
    depth_ = samples(GL_DEPTH_COMPONENT24, width_, height_, 0);
    facts_ = framebuffer();
    constexpr std::array<GLenum, 4> formats{GL_RGBA8, GL_RGBA16F, GL_RGBA8, GL_RG32F};
    std::array<GLenum, 4> places{};
    for (std::size_t i = 0; i < formats.size(); ++i) {
        facts_pictures_[i] = picture(formats[i], width_, height_);
        places[i] = static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + i);
        attach_picture(places[i], facts_pictures_[i]);
    }
    glDrawBuffers(static_cast<GLsizei>(places.size()), places.data());
    attach_samples(GL_DEPTH_ATTACHMENT, depth_);
    require_complete("single-precision numbers");
    pass_picture_ = picture(GL_RGBA16F, width_, height_);
    pass_ = framebuffer();
    attach_picture(GL_COLOR_ATTACHMENT0, pass_picture_);
    attach_samples(GL_DEPTH_ATTACHMENT, depth_);
    require_complete("half-precision numbers");
    const bool wide =
        epoxy_has_gl_extension("GL_EXT_color_buffer_float") && epoxy_has_gl_extension("GL_EXT_float_blend");
    sum_picture_ = picture(wide ? GL_RGBA32F : GL_RGBA16F, width_, height_);
    sum_ = framebuffer();
    attach_picture(GL_COLOR_ATTACHMENT0, sum_picture_);
    require_complete("single-precision numbers");
    check_gl("a picture");
}

namespace {

void begin(const GlName& target, GLsizei width, GLsizei height) {
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    glViewport(0, 0, width, height);
}

void clear(GLbitfield what) {
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearColor(0, 0, 0, 0);
    glClear(what);
}

}  // namespace

void Targets::begin_draft() {
    begin(draft_, width_, height_);
    clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void Targets::end_draft() {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, draft_.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, done_.name());
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Targets::begin_sum() {
    if (sum_.name() == 0) make_full();
    begin(sum_, width_, height_);
    clear(GL_COLOR_BUFFER_BIT);
}

void Targets::begin_shadow() {
    begin(shadow_, shadow_size, shadow_size);
    clear(GL_DEPTH_BUFFER_BIT);
}

void Targets::begin_facts() {
    begin(facts_, width_, height_);
    clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

// Keeps the depth of the facts.
void Targets::begin_pass() {
    begin(pass_, width_, height_);
    clear(GL_COLOR_BUFFER_BIT);
}

void Targets::begin_adding() {
    begin(sum_, width_, height_);
}

void Targets::begin_developing() {
    begin(done_, width_, height_);
}

Picture Targets::read() const {
    Picture picture{static_cast<std::uint32_t>(width_), static_cast<std::uint32_t>(height_), {}};
    picture.rgba.resize(std::size_t{4} * picture.width * picture.height);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, done_.name());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, picture.rgba.data());
    return picture;
}

}  // namespace mien
