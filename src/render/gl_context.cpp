// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// EGL without surfaces: a context is made current with none, and everything is drawn into framebuffers of our own. The
// display is a device of EGL_EXT_platform_device (graphics cards and Mesa's processor driver alike) or, where that
// extension is absent, Mesa's surfaceless platform; the default display would ask for X.

#include "render/gl_context.hpp"

#include <array>
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <string_view>
#include <vector>

#include "mien/error.hpp"

namespace mien {

namespace {

[[noreturn]] void no_driver(const std::string& found) {
    throw Error(
        "render: expected a driver for OpenGL ES 3 that draws without a window (on Debian libegl1, libgles2 and "
        "libgl1-mesa-dri), found " +
        found);
}

// libepoxy ends the program when these are absent, so they are asked for first.
void require_libraries() {
    for (const char* name : {"libEGL.so.1", "libGLESv2.so.2"}) {
        void* library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
        if (library == nullptr) no_driver(std::string("no ") + name);
        dlclose(library);
    }
}

bool has(const char* list, std::string_view name) {
    return list != nullptr && (' ' + std::string(list) + ' ').find(' ' + std::string(name) + ' ') != std::string::npos;
}

// Displays to try, in this order.
std::vector<EGLDisplay> displays(bool software) {
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    std::vector<EGLDisplay> cards, processors;
    if (has(client, "EGL_EXT_platform_device") &&
        (has(client, "EGL_EXT_device_base") || has(client, "EGL_EXT_device_enumeration"))) {
        std::array<EGLDeviceEXT, 32> devices{};
        EGLint count = 0;
        if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count) != EGL_TRUE) count = 0;
        for (EGLint i = 0; i < count; ++i) {
            const char* extensions = eglQueryDeviceStringEXT(devices[static_cast<std::size_t>(i)], EGL_EXTENSIONS);
            (has(extensions, "EGL_MESA_device_software") ? processors : cards)
                .push_back(
                    eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
        }
    }
    if (has(client, "EGL_MESA_platform_surfaceless"))
        processors.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    if (!software) processors.insert(processors.begin(), cards.begin(), cards.end());
    return processors;
}

// A context on the display, or nothing.
EGLContext context_on(EGLDisplay display) {
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) return EGL_NO_CONTEXT;
    if (!has(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context")) return EGL_NO_CONTEXT;
    if (eglBindAPI(EGL_OPENGL_ES_API) != EGL_TRUE) return EGL_NO_CONTEXT;
    const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display, wanted.data(), &config, 1, &count) != EGL_TRUE || count == 0) return EGL_NO_CONTEXT;
    const std::array<EGLint, 5> version{EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_NONE};
    return eglCreateContext(display, config, EGL_NO_CONTEXT, version.data());
}

}  // namespace

GlContext::GlContext(bool software) {
    require_libraries();
    for (EGLDisplay display : displays(software)) {
        EGLContext context = context_on(display);
        if (context == EGL_NO_CONTEXT) continue;
        if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE) {
            eglDestroyContext(display, context);
            continue;
        }
        display_ = display;
        context_ = context;
        device = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        return;
    }
    no_driver("none that works");
}

GlContext::~GlContext() {
    // The display is shared by all contexts of the program and stays.
    if (eglGetCurrentContext() == context_) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
}

void GlContext::use() const {
    if (eglGetCurrentContext() == context_) return;
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
        throw Error(
            "render: expected the driver to take up its context again, found that it does not; it may be in use in "
            "another thread");
}

}  // namespace mien
