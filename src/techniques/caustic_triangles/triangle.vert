// SPDX-License-Identifier: MIT
// Caustic triangles on a face of the cube map, six vertices for each square of four photons [Umenhoffer2009, 6.1.2].
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/caustic_triangles/caustic_triangles_params.h"

layout(set = 0, binding = 0, scalar) uniform params { CausticFaceParams p; };
layout(set = 0, binding = 1) uniform sampler2D hits;
layout(set = 0, binding = 2) uniform sampler2D areas;
layout(set = 0, binding = 3) uniform sampler2D irradiance;
layout(location = 0) out vec3 value;

void main() {
    int square = gl_VertexIndex / 6;
    int t = gl_VertexIndex / 3 % 2;
    ivec2 q = ivec2(square % p.photons, square / p.photons);
    vec2 drawn = texelFetch(areas, q, 0).rg;
    gl_Position = vec4(2.0, 2.0, 0.5, 1.0);
    value = vec3(0);
    if ((t == 0 ? drawn.x : drawn.y) <= 0.0) return;
    ivec2 pixel = caustic_corner(q, t, gl_VertexIndex % 3);
    gl_Position = p.to_clip * vec4(texelFetch(hits, pixel, 0).xyz, 1.0);
    value = texelFetch(irradiance, pixel, 0).rgb;
}
