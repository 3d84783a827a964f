// SPDX-License-Identifier: MIT
// Areas of both triangles of each square of four photons; 0: not drawn, as a corner is missing, the triangle is torn
// between surfaces, or it is smaller than a texel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/caustic_triangles/caustic_triangles_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { CausticAreaParams p; };
layout(binding = 1) uniform sampler2D hits;
layout(binding = 2) uniform samplerCube distance_map;
layout(binding = 3, rg32f) uniform writeonly image2D areas; // m2

float area(ivec2 q, int t) {
    vec4 a = texelFetch(hits, caustic_corner(q, t, 0), 0);
    vec4 b = texelFetch(hits, caustic_corner(q, t, 1), 0);
    vec4 c = texelFetch(hits, caustic_corner(q, t, 2), 0);
    if (min(a.a, min(b.a, c.a)) < 0.5) return 0.0;
    vec3 middle = (a.xyz + b.xyz + c.xyz) / 3.0;
    float distance = length(middle);
    if (abs(textureLod(distance_map, middle, 0.0).r / distance - 1.0) > p.tear) return 0.0;

    // Against a texel in the middle of a face.
    vec3 twice = cross(b.xyz - a.xyz, c.xyz - a.xyz);
    float seen = 0.5 * abs(dot(twice, middle)) / (distance * distance * distance);
    float texel = 2.0 / float(p.size);
    return seen < p.least * texel * texel ? 0.0 : 0.5 * length(twice);
}

void main() {
    ivec2 q = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(q, ivec2(p.photons)))) return;
    bool inside = all(lessThan(q, ivec2(p.photons - 1)));
    imageStore(areas, q, vec4(inside ? area(q, 0) : 0.0, inside ? area(q, 1) : 0.0, 0, 0));
}
