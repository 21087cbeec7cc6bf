// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <string>

namespace mien {

/// An OpenGL ES 3 context that needs no window and no X server.
class GlContext {
public:
    /// Tries the graphics cards first, then Mesa's driver that draws on the processor; with `software` only that.
    /// Throws Error that says what is missing.
    explicit GlContext(bool software);
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    /// Makes it the one that this thread's OpenGL calls mean.
    void use() const;

    std::string device;  ///< the driver's own name

private:
    void* display_ = nullptr;
    void* context_ = nullptr;
};

}  // namespace mien
