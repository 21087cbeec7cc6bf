// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Shading. Light that is reflected at once follows the microfacet model (T. Trowbridge and K. Reitz's distribution as
// in B. Walter et al. 2007, R. Schlick's Fresnel term); lamps are rectangles whose nearest point to the mirrored line
// of sight stands for all of it, with the lobe's energy widened accordingly (B. Karis 2013). Skin has two lobes, and
// what it does not reflect wraps round the terminator further in red than in blue, keeping its energy; where a lamp's
// shadow map says how far the light came through, it fades as exp(-thickness / path) per channel (after S. Green 2004).
// The light of the room is a gradient from the ground to the sky; its reflection uses B. Karis' fit (2014).

#include "render/shaders.hpp"

namespace mien::shaders {

namespace {

const char* const precisions = R"(
precision highp float;
precision highp int;
precision highp sampler2D;
)";

const char* const light_declarations = R"(
uniform vec3 camera;  // from what the camera looks at, as all places
uniform int lamps;
uniform vec3 lamp[8], across[8], upward[8], light[8];
uniform vec3 sky, ground;
uniform bool dome;      // full: the lamp is a place on the dome
uniform vec3 sample_at; // full: the direction of the place on the lamp whose shadow is known
uniform sampler2D shadow_map;
uniform mat4 shadow;
uniform vec3 shadow_size;  // of a texel, of the whole depth, in the scene's unit; of a texel in the map
uniform float grain;
)";

const char* const surface_facts = R"(
struct Surface {
    vec3 base, n, coat;  // coat: the normal of the wet layer
    vec3 scatter, glow;
    float alpha, metal, rough, wetness;
    float path;             // how far red light goes in what scatters all of it
    vec3 diffuse, reflect;  // parts of the base colour
};
// Metal mirrors its colour and nothing else; other matter mirrors as much as its refraction makes it, 1.5 or skin's 1.4.
void part(inout Surface s) {
    s.diffuse = s.base * (1.0 - s.metal);
    s.reflect = mix(vec3(s.scatter.r > 0.01 ? 0.028 : 0.04), s.base, s.metal);
}
)";

const char* const material_declarations = R"(
in vec3 position;
in vec3 normal;
in vec2 uv;
in vec3 eye;
in float value;

uniform vec4 colour;
uniform float metallic, roughness, normal_scale, cutoff;
uniform vec3 emission, scatter;
uniform int alpha_mode;  // 0 opaque, 1 mask, 2 blend, 3 the solid part of blend
uniform bool unlit, painted, wet;
uniform vec4 pictures;  // 1 where there is one: colour, roughness, normal, emission
uniform sampler2D colour_picture, roughness_picture, normal_picture, emission_picture, scale;
uniform vec2 scale_ends;
)";

const char* const material = R"(
// Directions of growing u and v on the surface, from how they change over the picture (C. Schueler 2013).
mat2x3 directions(vec2 at, vec3 n) {
    vec3 px = dFdx(position), py = dFdy(position);
    vec2 ux = dFdx(at), uy = dFdy(at);
    vec3 a = cross(py, n), b = cross(n, px);
    vec3 t = a * ux.x + b * uy.x, s = a * ux.y + b * uy.y;
    float size = max(dot(t, t), dot(s, s)), side = dot(cross(px, py), n) < 0.0 ? -1.0 : 1.0;
    return mat2x3(t, s) * (size > 0.0 ? side * inversesqrt(size) : 0.0);
}

float noise(vec2 p) {
    vec2 i = floor(p), f = fract(p);
    f = f * f * (3.0 - 2.0 * f);
    vec4 h = fract(sin(vec4(dot(i, vec2(127.1, 311.7)), dot(i + vec2(1, 0), vec2(127.1, 311.7)),
                            dot(i + vec2(0, 1), vec2(127.1, 311.7)), dot(i + 1.0, vec2(127.1, 311.7)))) * 43758.5453);
    return mix(mix(h.x, h.y, f.x), mix(h.z, h.w, f.x), f.y);
}

// An eyeball without a picture: white, a blue-grey iris of 11.7 mm on a ball of 24 mm, a pupil, a bulging cornea.
void paint_eye(inout Surface s) {
    vec3 e = normalize(eye);
    float r = e.z > 0.0 ? length(e.xy) : 2.0;
    float round_angle = atan(e.y, e.x);
    float fibre = noise(vec2(round_angle * 14.0, r * 9.0)) * 0.6 + noise(vec2(round_angle * 37.0, r * 14.0)) * 0.4;
    vec3 inner = vec3(0.33, 0.27, 0.16), outer = vec3(0.10, 0.17, 0.22);
    vec3 iris = mix(inner, outer, smoothstep(0.20, 0.34, r)) * (0.55 + 0.75 * fibre);
    iris = mix(iris, vec3(0.02, 0.025, 0.03), smoothstep(0.40, 0.485, r));
    iris = mix(vec3(0.004), iris, smoothstep(0.165, 0.195, r));
    vec3 white = mix(vec3(0.80, 0.76, 0.73), vec3(0.72, 0.45, 0.40), 0.75 * smoothstep(0.62, 1.05, r));
    float is_white = smoothstep(0.465, 0.52, r);
    s.base = mix(iris, white, is_white);
    s.metal = 0.0;
    s.scatter = vec3(0.5, 0.3, 0.25) * is_white;
    mat2x3 d = directions(e.xy, s.n);
    vec3 outwards = d * e.xy;
    float bulge = 1.0 - smoothstep(0.40, 0.56, r);
    s.coat = normalize(s.n + 0.55 * bulge * outwards);
    s.n = normalize(s.n - 0.9 * (1.0 - is_white) * outwards);
    s.rough = 0.5;
    s.wetness = 1.0;
}

Surface surface() {
    Surface s;
    vec4 base = colour;
    if (pictures.x > 0.0) base *= texture(colour_picture, uv);
    s.alpha = alpha_mode == 0 ? 1.0 : base.a;
    if (alpha_mode == 1 && base.a < cutoff) discard;
    if (alpha_mode == 1) s.alpha = 1.0;
    if (alpha_mode == 3 && base.a < 0.99) discard;
    if (alpha_mode == 2 && base.a >= 0.99) discard;
    vec2 mr = vec2(roughness, metallic);
    if (pictures.y > 0.0) mr *= texture(roughness_picture, uv).gb;
    s.rough = clamp(mr.x, 0.05, 1.0);
    s.scatter = scatter;
    s.base = base.rgb;
    s.metal = mr.y;
    s.glow = emission;
    if (pictures.w > 0.0) s.glow *= texture(emission_picture, uv).rgb;
    s.n = normalize(normal) * (gl_FrontFacing ? 1.0 : -1.0);
    s.coat = s.n;
    s.wetness = wet ? 1.0 : 0.0;
    if (pictures.z > 0.0) {
        vec3 m = texture(normal_picture, uv).xyz * 2.0 - 1.0;
        mat2x3 d = directions(uv, s.n);
        s.n = normalize(s.n * m.z + normal_scale * (d[0] * m.x - d[1] * m.y));
    }
    bool is_eye = dot(eye, eye) > 0.25;
    if (is_eye) paint_eye(s);
    if (painted && !isnan(value)) {
        float share = clamp((value - scale_ends.x) / (scale_ends.y - scale_ends.x), 0.0, 1.0);
        s.base = from_srgb(texture(scale, vec2((share * 255.0 + 0.5) / 256.0, 0.5)).rgb);
        s.metal = 0.0;
        s.rough = 0.7;
        s.scatter = vec3(0.0);
        s.wetness = 0.0;
        is_eye = false;
    }
    part(s);
    if (is_eye) s.reflect = vec3(0.0);  // under its tears
    return s;
}
)";

const char* const lobes = R"(
// Distribution and masking of one lobe towards the nearest place on a lamp, without Fresnel; times pi, as light is
// counted. A lobe narrower than the lamp mirrors all of it, which `widened` makes up for.
float lobe(float alpha, float widened, float nh, float nl, float nv) {
    float a2 = alpha * alpha;
    float d = nh * nh * (a2 - 1.0) + 1.0;
    float k = 0.5 * alpha;
    float mask = 0.25 / ((nl * (1.0 - k) + k) * (nv * (1.0 - k) + k));
    return a2 * a2 / (d * d * widened * widened) * mask;
}

// What a lamp's mirror image adds.
vec3 mirrored(int i, vec3 n, vec3 v, vec3 f0, float rough) {
    vec3 r = reflect(-v, n);
    float facing = dot(r, lamp[i]);
    vec3 l = lamp[i];
    float half_size = length(across[i]);
    if (facing > 0.0 && half_size > 0.0) {
        vec3 off = r / facing - lamp[i];
        l = normalize(lamp[i] + clamp(dot(off, across[i]) / (half_size * half_size), -1.0, 1.0) * across[i] +
                      clamp(dot(off, upward[i]) / (half_size * half_size), -1.0, 1.0) * upward[i]);
    }
    float nl = dot(n, l);
    if (nl <= 0.0) return vec3(0.0);
    vec3 h = normalize(l + v);
    float nh = clamp(dot(n, h), 0.0, 1.0), nv = max(dot(n, v), 0.05);
    float alpha = rough * rough, widened = min(alpha + 0.5 * half_size, 1.0);
    float fresnel = pow(1.0 - clamp(dot(v, h), 0.0, 1.0), 5.0);
    return (f0 + (1.0 - f0) * fresnel) * (lobe(alpha, widened, nh, nl, nv) * nl);
}

// The part of the room's light that the surface mirrors.
vec3 room_share(vec3 f0, float rough, float nv) {
    vec4 r = rough * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
    vec2 ab = vec2(-1.04, 1.04) * a + r.zw;
    return f0 * ab.x + ab.y;
}
vec3 room(vec3 direction, float blur) {
    return mix(ground, sky, smoothstep(-0.4 - 0.6 * blur, 0.4 + 0.6 * blur, direction.y));
}

vec3 reflection(int i, Surface s, vec3 v) {
    vec3 sum = s.wetness > 0.0 ? s.wetness * mirrored(i, s.coat, v, vec3(0.025), 0.12) : vec3(0.0);
    if (s.scatter.r > 0.0 && s.wetness == 0.0)
        return sum + 0.35 * mirrored(i, s.n, v, s.reflect, 0.65 * s.rough) + 0.65 * mirrored(i, s.n, v, s.reflect, s.rough);
    return s.reflect.r + s.reflect.g + s.reflect.b > 0.0 ? sum + mirrored(i, s.n, v, s.reflect, s.rough) : sum;
}
vec3 room_reflection(Surface s, vec3 v) {
    float nv = clamp(dot(s.n, v), 0.0, 1.0);
    vec3 sum = s.reflect.g > 0.0
                   ? room_share(s.reflect, s.rough, nv) * room(reflect(-v, s.n), s.rough) : vec3(0.0);
    if (s.wetness > 0.0)
        sum += s.wetness * room_share(vec3(0.025), 0.12, clamp(dot(s.coat, v), 0.0, 1.0)) *
               room(reflect(-v, s.coat), 0.1);
    return sum;
}

// Diffuse light by the angle to the lamp, per channel; its mean over all angles is the same for any `w`.
vec3 wrapped(float nl, vec3 w) {
    return max((nl + w) / ((1.0 + w) * (1.0 + w)), 0.0);
}
)";

const char* const draft_light = R"(
// Without shadows, light that wraps far round would glow in every hollow.
vec3 lit(Surface s, vec3 v, vec3 at) {
    vec3 diffuse = mix(ground, sky, 0.5 + 0.33 * s.n.y), reflected = room_reflection(s, v);
    for (int i = 0; i < lamps; ++i) {
        diffuse += light[i] * wrapped(dot(s.n, lamp[i]), 0.2 * s.scatter);
        reflected += light[i] * reflection(i, s, v);
    }
    return s.diffuse * diffuse * s.alpha + min(reflected, 8.0) + s.glow;
}
vec3 shown_as_it_is(vec3 c) { return to_srgb(c); }
vec3 developed(vec3 c) { return to_srgb(film(c)); }
)";

const char* const full_light = R"(
// What is in shadow is lit by the same matter round it, which took its colour once more: without that, an open mouth is
// a black hole.
const float bounced = 0.3;

// How much of the light arrives, per channel: all, none, or what came through.
vec3 arriving(Surface s, vec3 place) {
    vec4 at = shadow * vec4(place + s.n * max(1.5 * shadow_size.x, 0.12 * s.path), 1.0);
    float turn = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))) + grain);
    // About a millimetre, so that the few places on a lamp leave no steps.
    float reach_of_arm = clamp(0.3 * s.path / shadow_size.x, 2.0, 9.0);
    vec2 arm = reach_of_arm * shadow_size.z * vec2(cos(turn), sin(turn));
    vec3 reach = max(s.path * s.scatter, 1e-6);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        float thick = (at.z - texture(shadow_map, at.xy + arm).r) * shadow_size.y;
        sum += thick < max(shadow_size.x, 0.06 * s.path) ? vec3(1.0) : exp(-thick / reach);
        arm = vec2(-arm.y, arm.x) * 0.8;
    }
    return 0.25 * sum;
}
vec3 lit(Surface s, vec3 v, vec3 at) {
    vec3 arrived = arriving(s, at), there = arrived + (1.0 - arrived) * bounced * s.base;
    vec3 diffuse = light[0] * wrapped(dot(s.n, sample_at), 0.45 * s.scatter) * there;
    vec3 reflected = arrived.b * (dome ? 4.0 * room_reflection(s, v) * light[1] * max(dot(s.n, sample_at), 0.0)
                                     : light[0] * reflection(0, s, v));
    return s.diffuse * diffuse * s.alpha + min(reflected, 24.0) + s.glow;
}
vec3 shown_as_it_is(vec3 c) { return unfilm(c); }
vec3 developed(vec3 c) { return c; }
)";

const char* const surface_main = R"(
out vec4 shown;
uniform float path;
void main() {
    Surface s = surface();
    s.path = path;
    vec3 c = unlit ? shown_as_it_is(s.diffuse) * s.alpha : developed(lit(s, normalize(camera - position), position));
    shown = vec4(c, s.alpha);
}
)";

const char* const facts_main = R"(
layout(location = 0) out vec4 base_fact;     // the root of the colour, and metal
layout(location = 1) out vec4 normal_fact;   // and roughness
layout(location = 2) out vec4 scatter_fact;  // and 1: there is a surface
layout(location = 3) out vec2 depth_fact;    // and how far light goes in what scatters it
uniform vec3 camera, forwards;
uniform float path;
void main() {
    Surface s = surface();
    base_fact = vec4(sqrt(s.base), s.metal);
    normal_fact = vec4(s.n, s.rough);
    scatter_fact = vec4(s.scatter, 1.0);
    depth_fact = vec2(dot(position - camera, forwards), path);
}
)";

const char* const deferred_main = R"(
uniform sampler2D base_facts, normal_facts, scatter_facts, depth_facts;
uniform vec3 ray, ray_x, ray_y;  // from the camera to the pixel at a depth of 1
out vec4 shown;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 scattered = texelFetch(scatter_facts, pixel, 0);
    vec4 base = texelFetch(base_facts, pixel, 0), turned = texelFetch(normal_facts, pixel, 0);
    vec2 depth = texelFetch(depth_facts, pixel, 0).xy;
    vec3 to = ray + gl_FragCoord.x * ray_x + gl_FragCoord.y * ray_y;
    Surface s;
    s.base = base.rgb * base.rgb;
    s.metal = base.a;
    s.path = depth.y;
    s.n = s.coat = turned.xyz;
    s.rough = turned.w;
    s.scatter = scattered.rgb;
    s.alpha = 1.0;
    s.wetness = 0.0;
    s.glow = vec3(0.0);
    part(s);
    shown = scattered.a > 0.0 ? vec4(lit(s, normalize(-to), camera + depth.x * to), 1.0) : vec4(0.0);
}
)";

// Light at the vertices, for surfaces of many small triangles.
const char* const quick_vertex_main = R"(
layout(location = 0) in vec3 posed_position;
layout(location = 1) in vec3 posed_normal;
layout(location = 2) in vec2 corner_uv;
layout(location = 4) in float vertex_value;
uniform mat4 view, place, turn;
uniform bool double_sided;
uniform float roughness, metallic;
uniform vec4 colour;
uniform vec3 scatter;
#ifdef ONE_COLOUR
out vec3 seen;
#else
out vec3 diffuse, reflected;
out vec2 uv;
out float value;
#endif
void main() {
    vec4 at = place * vec4(posed_position, 1.0);
    vec3 v = normalize(camera - at.xyz);
    Surface s;
    s.base = colour.rgb;
    s.metal = metallic;
    s.n = s.coat = normalize(mat3(turn) * posed_normal);
    if (double_sided && dot(s.n, v) < -0.2) s.n = -s.n;
    s.rough = clamp(roughness, 0.05, 1.0);
    s.scatter = scatter;
    s.alpha = 1.0;
    s.wetness = 0.0;
    part(s);
    float kept = 1.0 - metallic;
    vec3 into = kept * mix(ground, sky, 0.5 + 0.33 * s.n.y), off = room_reflection(s, v);
    for (int i = 0; i < lamps; ++i) {
        into += kept * light[i] * wrapped(dot(s.n, lamp[i]), 0.2 * scatter);
        off += light[i] * reflection(i, s, v);
    }
#ifdef ONE_COLOUR
    seen = quick_film(colour.rgb * into + off);
#else
    diffuse = into;
    reflected = off;
    uv = corner_uv;
    value = vertex_value;
#endif
    gl_Position = view * at;
}
)";

const char* const quick_fragment_main = R"(
in vec3 diffuse, reflected;
in vec2 uv;
in float value;
uniform vec4 colour, pictures;
uniform float cutoff;
uniform int alpha_mode;
uniform bool painted;
uniform sampler2D colour_picture, scale;
uniform vec2 scale_ends;
out vec4 shown;
void main() {
    vec4 base = colour;
    if (pictures.x > 0.0) base *= texture(colour_picture, uv);
    if (alpha_mode == 1 && base.a < cutoff) discard;
    vec3 mirror = reflected;
    if (painted && !isnan(value)) {
        float share = clamp((value - scale_ends.x) / (scale_ends.y - scale_ends.x), 0.0, 1.0);
        base.rgb = from_srgb(texture(scale, vec2((share * 255.0 + 0.5) / 256.0, 0.5)).rgb);
        mirror *= 0.3;
    }
    shown = vec4(quick_film(base.rgb * diffuse + mirror), 1.0);
}
)";

const char* const one_colour_fragment = R"(
in vec3 seen;
out vec4 shown;
void main() { shown = vec4(seen, 1.0); }
)";

const std::string version = "#version 300 es\n";

}  // namespace

std::string surface_vertex() {
    return R"(#version 300 es
precision highp float;
layout(location = 0) in vec3 posed_position;
layout(location = 1) in vec3 posed_normal;
layout(location = 2) in vec2 corner_uv;
layout(location = 3) in vec3 eye_direction;
layout(location = 4) in float vertex_value;
uniform mat4 view, place, turn;
out vec3 position, normal, eye;
out vec2 uv;
out float value;
void main() {
    vec4 at = place * vec4(posed_position, 1.0);
    position = at.xyz;
    normal = mat3(turn) * posed_normal;
    uv = corner_uv;
    eye = eye_direction;
    value = vertex_value;
    gl_Position = view * at;
}
)";
}

std::string surface_fragment(bool full) {
    return version + precisions + light_declarations + surface_facts + material_declarations + film + material + lobes +
           (full ? full_light : draft_light) + surface_main;
}

std::string facts_fragment() {
    return version + precisions + surface_facts + material_declarations + film + material + facts_main;
}

std::string deferred_fragment() {
    return version + precisions + light_declarations + surface_facts + film + lobes + full_light + deferred_main;
}

std::string quick_vertex(bool one_colour) {
    return version + (one_colour ? "#define ONE_COLOUR\n" : "") + precisions + light_declarations + surface_facts +
           film + lobes + quick_vertex_main;
}

std::string quick_fragment(bool one_colour) {
    return version + precisions + (one_colour ? one_colour_fragment : film + quick_fragment_main);
}

const std::string shadow_vertex = R"(#version 300 es
precision highp float;
layout(location = 0) in vec3 posed_position;
layout(location = 2) in vec2 corner_uv;
uniform mat4 view, place;
out vec2 uv;
void main() {
    uv = corner_uv;
    gl_Position = view * (place * vec4(posed_position, 1.0));
}
)";

const std::string shadow_fragment = R"(#version 300 es
precision highp float;
in vec2 uv;
uniform sampler2D colour_picture;
uniform float alpha, cutoff;
uniform bool pictured;
void main() {
    if (pictured && alpha * texture(colour_picture, uv).a < cutoff) discard;
}
)";

const std::string wire_vertex = R"(#version 300 es
precision highp float;
layout(location = 0) in vec3 posed_position;
uniform mat4 view, place;
void main() {
    gl_Position = view * (place * vec4(posed_position, 1.0));
    gl_Position.z -= 4e-4 * gl_Position.w;
}
)";

const std::string wire_fragment = R"(#version 300 es
precision highp float;
uniform vec4 colour;  // premultiplied
out vec4 shown;
void main() { shown = colour; }
)";

}  // namespace mien::shaders
