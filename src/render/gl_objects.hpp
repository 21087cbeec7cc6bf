// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <epoxy/gl.h>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mien/vec.hpp"

namespace mien {

/// Owns one name of an OpenGL object; the context must be current whenever it is made or ends.
class GlName {
public:
    enum class Kind { buffer, texture, framebuffer, renderbuffer, vertex_array };

    GlName() = default;
    explicit GlName(Kind kind);
    ~GlName() { release(); }
    GlName(GlName&& other) noexcept : kind_(other.kind_), name_(std::exchange(other.name_, 0U)) {}
    GlName& operator=(GlName&& other) noexcept;

    [[nodiscard]] GLuint name() const { return name_; }

private:
    void release();
    Kind kind_ = Kind::buffer;
    GLuint name_ = 0;
};

/// Columns of four, as OpenGL takes them.
using Matrix = std::array<float, 16>;

/// A linked program. Throws Error with the driver's words when it does not compile.
class GlProgram {
public:
    GlProgram() = default;
    /// `captured`: outputs that transform feedback writes, one after the other.
    GlProgram(const std::string& vertex, const std::string& fragment, std::span<const char* const> captured = {});
    ~GlProgram();
    GlProgram(GlProgram&& other) noexcept
        : name_(std::exchange(other.name_, 0U)), locations_(std::move(other.locations_)) {}
    GlProgram& operator=(GlProgram&& other) noexcept;

    void use() const { glUseProgram(name_); }
    void set(const char* uniform, int value);
    void set(const char* uniform, float value);
    void set(const char* uniform, const std::array<float, 2>& value);
    void set(const char* uniform, const std::array<float, 3>& value);
    void set(const char* uniform, const std::array<float, 4>& value);
    void set(const char* uniform, const Vec3f& value) { set(uniform, std::array{value.x, value.y, value.z}); }
    void set(const char* uniform, const Matrix& value);
    void set(const char* uniform, std::span<const std::array<float, 3>> values);

private:
    GLint location(const char* uniform);
    GLuint name_ = 0;
    std::map<std::string, GLint, std::less<>> locations_;
};

/// A place in the bound buffer, in bytes, as OpenGL wants to be told it.
inline const void* buffer_offset(std::size_t bytes) {
    return std::bit_cast<const void*>(static_cast<std::uintptr_t>(bytes));
}

/// A buffer filled once.
template <class T>
GlName filled_buffer(GLenum target, std::span<const T> values, GLenum usage = GL_STATIC_DRAW) {
    GlName buffer(GlName::Kind::buffer);
    glBindBuffer(target, buffer.name());
    glBufferData(target, static_cast<GLsizeiptr>(values.size_bytes()), values.data(), usage);
    return buffer;
}

/// A list of four numbers each, read in shaders by its index: rows of `list_width` texels.
inline constexpr GLsizei list_width = 2048;
using Texel = std::array<float, 4>;
struct GlList {
    GlName texture;
    GLsizei rows = 0;
};
/// Puts `texels` (filled up with zeros to whole rows) into the list, which grows when it must. Throws Error if the
/// driver's textures are not large enough; `what` names the texels.
void fill(GlList& list, std::vector<Texel>& texels, const char* what);

void bind_texture(int unit, GLuint texture);

/// Throws Error if the driver reported one since the last call: in practice that its memory is full.
void check_gl(const char* doing);
void forget_gl_errors();

}  // namespace mien
