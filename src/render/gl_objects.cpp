// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "render/gl_objects.hpp"

#include <fmt/format.h>

#include "mien/error.hpp"

namespace mien {

GlName::GlName(Kind kind) : kind_(kind) {
    switch (kind_) {
        case Kind::buffer:
            glGenBuffers(1, &name_);
            break;
        case Kind::texture:
            glGenTextures(1, &name_);
            break;
        case Kind::framebuffer:
            glGenFramebuffers(1, &name_);
            break;
        case Kind::renderbuffer:
            glGenRenderbuffers(1, &name_);
            break;
        case Kind::vertex_array:
            glGenVertexArrays(1, &name_);
            break;
    }
}

void GlName::release() {
    if (name_ == 0) return;
    switch (kind_) {
        case Kind::buffer:
            glDeleteBuffers(1, &name_);
            break;
        case Kind::texture:
            glDeleteTextures(1, &name_);
            break;
        case Kind::framebuffer:
            glDeleteFramebuffers(1, &name_);
            break;
        case Kind::renderbuffer:
            glDeleteRenderbuffers(1, &name_);
            break;
        case Kind::vertex_array:
            glDeleteVertexArrays(1, &name_);
            break;
    }
    name_ = 0;
}

GlName& GlName::operator=(GlName&& other) noexcept {
    if (this != &other) {
        release();
        kind_ = other.kind_;
        name_ = std::exchange(other.name_, 0U);
    }
    return *this;
}

namespace {

GLuint compiled(GLenum stage, const std::string& source) {
    const GLuint shader = glCreateShader(stage);
    const char* text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint done = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done == GL_TRUE) return shader;
    std::array<char, 2048> words{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(words.size()), nullptr, words.data());
    glDeleteShader(shader);
    throw Error(fmt::format("render: expected the driver to compile the {} shader, found \"{}\"",
                            stage == GL_VERTEX_SHADER ? "vertex" : "fragment", words.data()));
}

}  // namespace

GlProgram::GlProgram(const std::string& vertex, const std::string& fragment, std::span<const char* const> captured) {
    const GLuint first = compiled(GL_VERTEX_SHADER, vertex);
    const GLuint second = compiled(GL_FRAGMENT_SHADER, fragment);
    name_ = glCreateProgram();
    glAttachShader(name_, first);
    glAttachShader(name_, second);
    glDeleteShader(first);
    glDeleteShader(second);
    if (!captured.empty())
        glTransformFeedbackVaryings(name_, static_cast<GLsizei>(captured.size()), captured.data(),
                                    GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(name_);
    GLint done = GL_FALSE;
    glGetProgramiv(name_, GL_LINK_STATUS, &done);
    if (done == GL_TRUE) return;
    std::array<char, 2048> words{};
    glGetProgramInfoLog(name_, static_cast<GLsizei>(words.size()), nullptr, words.data());
    glDeleteProgram(name_);
    throw Error(fmt::format("render: expected the driver to link a program, found \"{}\"", words.data()));
}

GlProgram::~GlProgram() {
    if (name_ != 0) glDeleteProgram(name_);
}

GlProgram& GlProgram::operator=(GlProgram&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(locations_, other.locations_);
    return *this;
}

GLint GlProgram::location(const char* uniform) {
    const auto found = locations_.find(std::string_view(uniform));
    if (found != locations_.end()) return found->second;
    return locations_.emplace(uniform, glGetUniformLocation(name_, uniform)).first->second;
}

void GlProgram::set(const char* uniform, int value) {
    glUniform1i(location(uniform), value);
}
void GlProgram::set(const char* uniform, float value) {
    glUniform1f(location(uniform), value);
}
void GlProgram::set(const char* uniform, const std::array<float, 2>& value) {
    glUniform2fv(location(uniform), 1, value.data());
}
void GlProgram::set(const char* uniform, const std::array<float, 3>& value) {
    glUniform3fv(location(uniform), 1, value.data());
}
void GlProgram::set(const char* uniform, const std::array<float, 4>& value) {
    glUniform4fv(location(uniform), 1, value.data());
}
void GlProgram::set(const char* uniform, const Matrix& value) {
    glUniformMatrix4fv(location(uniform), 1, GL_FALSE, value.data());
}
void GlProgram::set(const char* uniform, std::span<const std::array<float, 3>> values) {
    glUniform3fv(location(uniform), static_cast<GLsizei>(values.size()), values.front().data());
}

void fill(GlList& list, std::vector<Texel>& texels, const char* what) {
    constexpr auto width = static_cast<std::size_t>(list_width);
    const std::size_t rows = std::max<std::size_t>(1, (texels.size() + width - 1) / width);
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (rows > static_cast<std::size_t>(limit))
        throw Error(fmt::format("render: expected at most {} {}, which is what this driver's textures hold, found {}",
                                static_cast<std::size_t>(limit) * width, what, texels.size()));
    const std::size_t used = texels.size();
    texels.resize(rows * width);
    if (list.texture.name() == 0) list.texture = GlName(GlName::Kind::texture);
    bind_texture(0, list.texture.name());
    const auto height = static_cast<GLsizei>(rows);
    if (height > list.rows) {
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, list_width, height, 0, GL_RGBA, GL_FLOAT, texels.data());
        for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
            glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
        list.rows = height;
    } else {
        const GLsizei across = rows == 1 ? static_cast<GLsizei>(used) : list_width;
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, across, height, GL_RGBA, GL_FLOAT, texels.data());
    }
}

void bind_texture(int unit, GLuint texture) {
    glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
    glBindTexture(GL_TEXTURE_2D, texture);
}

void forget_gl_errors() {
    // A driver that was lost reports without end.
    for (int i = 0; i < 100 && glGetError() != GL_NO_ERROR; ++i) {
    }
}

void check_gl(const char* doing) {
    const GLenum first = glGetError();
    if (first == GL_NO_ERROR) return;
    forget_gl_errors();
    if (first == GL_OUT_OF_MEMORY)
        throw Error(fmt::format("render: expected memory for {}, found that the driver has none left", doing));
    throw Error(fmt::format("render: expected the driver to manage {}, found its error {:#x}", doing, first));
}

}  // namespace mien
