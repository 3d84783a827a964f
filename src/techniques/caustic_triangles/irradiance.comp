// SPDX-License-Identifier: MIT
// Irradiance at each photon: its power over its share of the triangles around it, whose linear interpolation then keeps
// the power. What would be on triangles that are not drawn is left, for a splat.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/caustic_triangles/caustic_triangles_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { CausticAreaParams p; };
layout(binding = 1) uniform sampler2D powers;
layout(binding = 2) uniform sampler2D areas;
layout(binding = 3, rgba32f) uniform writeonly image2D irradiance; // W/m2
layout(binding = 4, rgba32f) uniform writeonly image2D left_over;  // W, not on triangles; a: m2 of the photon

vec2 areas_at(ivec2 q) { return any(lessThan(q, ivec2(0))) ? vec2(0) : texelFetch(areas, q, 0).rg; }

void main() {
    ivec2 q = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(q, ivec2(p.photons)))) return;
    vec2 before = areas_at(q - ivec2(1, 0)), above = areas_at(q - ivec2(0, 1));
    float around[6] = float[](areas_at(q).x, before.x, before.y, above.x, above.y, areas_at(q - ivec2(1)).y);
    float sum = 0.0, drawn = 0.0;
    for (int i = 0; i < 6; ++i) {
        sum += around[i];
        drawn += around[i] > 0.0 ? 1.0 : 0.0;
    }
    vec3 power = texelFetch(powers, q, 0).rgb;
    vec4 left = vec4(power, 0.0);
    vec3 found = vec3(0);
    if (sum > 0.0) {
        float own = p.share * sum * (p.rim == CAUSTIC_RIM_FLUX ? 1.0 : 6.0 / drawn);
        found = power / own;
        left = p.rim == CAUSTIC_RIM_SPLAT ? vec4(power * (1.0 - drawn / 6.0), own) : vec4(0);
    }
    imageStore(irradiance, q, vec4(found, 0));
    imageStore(left_over, q, left);
}
