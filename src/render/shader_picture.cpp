// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "render/shaders.hpp"

namespace mien::shaders {

// The curve is K. Narkowicz's fit to the ACES film curve (2015): x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14).
const std::string film = R"(
vec3 film(vec3 x) { return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0); }
vec3 unfilm(vec3 y) {
    vec3 a = 2.51 - 2.43 * y, b = 0.03 - 0.59 * y, c = -0.14 * y;
    return (-b + sqrt(max(b * b - 4.0 * a * c, 0.0))) / (2.0 * a);
}
vec3 to_srgb(vec3 c) {
    return mix(12.92 * c, 1.055 * pow(max(c, 0.0031308), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
// to_srgb(film(x)) for drafts, within 0.005 of it: a ratio of squares in the root of x.
vec3 quick_film(vec3 x) {
    vec3 s = sqrt(max(x, 0.0));
    return clamp((s * (4.9343 * s + 0.1695) - 0.01442) / (s * (5.0493 * s - 0.46006) + 1.0), 0.0, 1.0);
}
vec3 from_srgb(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c)); }
)";

// Balls turned to the camera: a square each, from which the corners are cut.
const std::string mark_vertex = R"(#version 300 es
precision highp float;
uniform mat4 view;
uniform vec2 size;  // of the ball in clip space, at distance 1
uniform vec3 place;
out vec2 corner;
void main() {
    corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    gl_Position = view * vec4(place, 1.0);
    gl_Position.xy += corner * size * gl_Position.w;
}
)";

const std::string mark_fragment = R"(#version 300 es
precision highp float;
in vec2 corner;
uniform vec3 colour;  // sRGB
uniform bool full;
out vec4 shown;
)" + film + R"(
void main() {
    float r = dot(corner, corner);
    if (r > 1.0) discard;
    vec3 n = vec3(corner.x, -corner.y, sqrt(1.0 - r));
    vec3 c = from_srgb(colour) * (0.35 + 0.65 * max(dot(n, normalize(vec3(-0.4, 0.6, 0.7))), 0.0));
    c = mix(c, vec3(1.0), 0.6 * smoothstep(0.95, 0.99, dot(n, normalize(vec3(-0.3, 0.5, 0.8)))));
    shown = vec4(full ? unfilm(c) : to_srgb(c), 1.0);
}
)";

const std::string cover_vertex = R"(#version 300 es
precision highp float;
out vec2 place;  // 0 to 1 from the upper left corner
void main() {
    place = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(place * 2.0 - 1.0, 1.0, 1.0);
}
)";

const std::string add_fragment = R"(#version 300 es
precision highp float;
uniform highp sampler2D picture;
out vec4 shown;
void main() { shown = texelFetch(picture, ivec2(gl_FragCoord.xy), 0); }
)";

// Lighter in the middle, as paper lit from the front is.
const std::string background_fragment = R"(#version 300 es
precision highp float;
in vec2 place;
uniform vec3 top, bottom;  // sRGB
out vec4 shown;
void main() {
    vec2 off = place - vec2(0.5, 0.45);
    shown = vec4(mix(top, bottom, smoothstep(0.0, 1.0, place.y)) * (1.06 - 0.35 * dot(off, off)), 1.0);
}
)";

// The sum over all passes: premultiplied light and coverage.
const std::string develop_fragment = R"(#version 300 es
precision highp float;
in vec2 place;
uniform highp sampler2D picture;
uniform float share;  // 1 / passes
uniform vec3 top, bottom;
uniform bool transparent;
out vec4 shown;
)" + film + R"(
void main() {
    vec4 light = texelFetch(picture, ivec2(gl_FragCoord.xy), 0) * share;
    light.a = min(light.a, 1.0);
    if (transparent) {
        shown = light.a > 0.0 ? vec4(to_srgb(film(light.rgb / light.a)), light.a) : vec4(0.0);
        return;
    }
    vec2 off = place - vec2(0.5, 0.45);
    vec3 paper = mix(top, bottom, smoothstep(0.0, 1.0, place.y)) * (1.06 - 0.35 * dot(off, off));
    vec3 behind = unfilm(from_srgb(clamp(paper, 0.0, 1.0)));
    // A step of dither keeps the gradient from banding; it depends on the pixel alone.
    float grain = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
    shown = vec4(to_srgb(film(light.rgb + (1.0 - light.a) * behind)) + grain / 255.0, 1.0);
}
)";

}  // namespace mien::shaders
