// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "render/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

#include "mien/error.hpp"

namespace mien {

namespace {

GlName uploaded(const Picture& picture, bool colours) {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (std::max(picture.width, picture.height) > static_cast<std::uint32_t>(limit))
        throw Error(fmt::format("render: expected pictures of at most {} pixels a side, found one of {} x {}", limit,
                                picture.width, picture.height));
    GlName texture(GlName::Kind::texture);
    bind_texture(0, texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, colours ? GL_SRGB8_ALPHA8 : GL_RGBA8, static_cast<GLsizei>(picture.width),
                 static_cast<GLsizei>(picture.height), 0, GL_RGBA, GL_UNSIGNED_BYTE, picture.rgba.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

}  // namespace

void upload_pictures(StillModel& still, const Scene& scene) {
    std::map<std::pair<std::uint32_t, bool>, std::uint32_t> known;
    for (const Material& material : scene.materials) {
        const std::array used{material.colour_picture, material.roughness_picture, material.normal_picture,
                              material.emission_picture};
        still.pictures_of.emplace_back();
        for (std::size_t use = 0; use < used.size(); ++use) {
            if (!used[use]) continue;
            const Picture& picture = scene.pictures[*used[use]];
            if (picture.width == 0 || picture.height == 0) continue;
            const bool colours = use == 0 || use == 3;
            const auto [found, is_new] =
                known.try_emplace({*used[use], colours}, static_cast<std::uint32_t>(still.pictures.size()));
            if (is_new) still.pictures.push_back(uploaded(picture, colours));
            still.pictures_of.back()[use] = found->second;
        }
    }
}

GlName scale_picture(ColourScale scale) {
    std::vector<std::uint8_t> texels;
    for (int i = 0; i < 256; ++i) {
        const Colour colour = colour_at(scale, i / 255.0);
        texels.insert(texels.end(), {colour.r, colour.g, colour.b, 255});
    }
    GlName texture(GlName::Kind::texture);
    bind_texture(0, texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 256, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
    return texture;
}

}  // namespace mien
