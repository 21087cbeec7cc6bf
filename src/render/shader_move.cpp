// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// One sum moves everything. A vertex v with rest position p, tangents t and b and rows of (index, weight, slopes):
//   p' = p + sum_k w_k a_k            a_k: displacement of point k, or the weight of shape k (then w_k is its delta)
//   t' = t + sum_k (dw_k/dt) a_k      b' likewise
// then the joints, p'' = sum_j w_j M_j p', whose derivative along t is sum_j w_j M_j t' + sum_j (dw_j/dt) M_j p';
// slopes of a full set of weights add up to zero, so M_0 p' may be taken from every M_j p', which keeps the digits.

#include "render/shaders.hpp"

namespace mien::shaders {

const std::string move_vertex = R"(#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;

layout(location = 0) in vec3 rest;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;  // and the hand of the other one
layout(location = 3) in ivec4 rows;    // of `plain`: first and count; of `full`: first and count
layout(location = 4) in ivec2 joints;  // of `bones`: first and count

uniform sampler2D plain;    // index, weight, slopes along t and b
uniform sampler2D full;     // index and weight; slope along t; slope along b: three texels
uniform sampler2D bones;    // as `plain`
uniform sampler2D amounts;  // one a point or shape
uniform sampler2D maps;     // three rows a joint
uniform int width_bits;

out vec3 posed_position;
out vec3 posed_normal;

vec4 at(sampler2D list, int i) {
    return texelFetch(list, ivec2(i & ((1 << width_bits) - 1), i >> width_bits), 0);
}

void main() {
    vec3 p = rest, t = tangent.xyz;
    vec3 b = tangent.w * cross(normal, t);
    for (int i = rows.x; i < rows.x + rows.y; ++i) {
        vec4 entry = at(plain, i);
        vec3 amount = at(amounts, int(entry.x)).xyz;
        p += entry.y * amount;
        t += entry.z * amount;
        b += entry.w * amount;
    }
    for (int i = rows.z; i < rows.z + rows.w; ++i) {
        vec4 entry = at(full, 3 * i);
        vec3 amount = at(amounts, int(entry.x)).xyz;
        if (amount == vec3(0.0)) continue;
        p += entry.yzw * amount;
        t += at(full, 3 * i + 1).xyz * amount;
        b += at(full, 3 * i + 2).xyz * amount;
    }
    vec3 q = vec3(0.0), u = vec3(0.0), v = vec3(0.0), first = vec3(0.0);
    for (int i = joints.x; i < joints.x + joints.y; ++i) {
        vec4 entry = at(bones, i);
        int j = 3 * int(entry.x);
        vec4 x = at(maps, j), y = at(maps, j + 1), z = at(maps, j + 2);
        vec3 moved = vec3(dot(x, vec4(p, 1.0)), dot(y, vec4(p, 1.0)), dot(z, vec4(p, 1.0)));
        if (i == joints.x) first = moved;
        vec3 off = moved - first;
        q += entry.y * off;
        u += entry.y * vec3(dot(x.xyz, t), dot(y.xyz, t), dot(z.xyz, t)) + entry.z * off;
        v += entry.y * vec3(dot(x.xyz, b), dot(y.xyz, b), dot(z.xyz, b)) + entry.w * off;
    }
    posed_position = first + q;
    vec3 n = cross(u, v);
    float size = length(n);
    posed_normal = size > 0.0 ? n / size : normal;
}
)";

const std::string move_fragment = R"(#version 300 es
void main() {}
)";

}  // namespace mien::shaders
