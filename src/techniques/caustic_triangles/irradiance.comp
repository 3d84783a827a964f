// SPDX-License-Identifier: MIT
// Irradiance at each photon: its power over its share of the triangles around it, whose linear interpolation then keeps
// the power. A photon without triangles keeps its power, for a splat.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/caustic_triangles/caustic_triangles_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { CausticAreaParams p; };
layout(binding = 1) uniform sampler2D powers;
layout(binding = 2) uniform sampler2D areas;
layout(binding = 3, rgba32f) uniform writeonly image2D irradiance; // a = 1: W/m2; a = 0: W

vec2 areas_at(ivec2 q) { return any(lessThan(q, ivec2(0))) ? vec2(0) : texelFetch(areas, q, 0).rg; }

void main() {
    ivec2 q = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(q, ivec2(p.photons)))) return;
    vec2 left = areas_at(q - ivec2(1, 0)), above = areas_at(q - ivec2(0, 1));
    float around[6] = float[](areas_at(q).x, left.x, left.y, above.x, above.y, areas_at(q - ivec2(1)).y);
    float sum = 0.0, drawn = 0.0;
    for (int i = 0; i < 6; ++i) {
        sum += around[i];
        drawn += around[i] > 0.0 ? 1.0 : 0.0;
    }
    if (p.density != 0u && drawn > 0.0) sum *= 6.0 / drawn;
    vec3 power = texelFetch(powers, q, 0).rgb;
    imageStore(irradiance, q, sum > 0.0 ? vec4(power / (p.share * sum), 1.0) : vec4(power, 0.0));
}
