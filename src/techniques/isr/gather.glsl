// SPDX-License-Identifier: MIT
// Irradiance of every coarse pixel from the patches around it, and its accessibility. The estimator is in the
// file that includes this one.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/isr/isr_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { IsrParams p; };
// A uniform block, not a storage buffer: uniformly indexed tables are 3 times faster there on CPU drivers.
layout(binding = 1) uniform taps { vec4 tap[ISR_MAX_TAPS]; }; // offset, weight in coarse pixels
layout(binding = 2) uniform sampler2D patches;
layout(binding = 3) uniform sampler2D receiver;
layout(binding = 4) uniform sampler2D source;
layout(binding = 5, rgba32f) uniform writeonly image2D irradiance; // rgb E in W/m2, a = accessibility

vec3 position_at(ivec2 coarse, float z) { return world_position(p.view, (vec2(coarse) + 0.5) * p.scale, z); }

// Is there a patch for the frame's coarse pixel `q`, which may lie beyond the frame?
bool has_patch(ivec2 q) {
    ivec2 t = q + p.origin;
    return t.x >= 0 && t.y >= 0 && t.x < p.patches.x && t.y < p.patches.y;
}
vec4 patch_at(ivec2 q) { return texelFetch(patches, q + p.origin, 0); }
vec3 source_at(ivec2 q) { return texelFetch(source, q + p.origin, 0).rgb; }

vec4 estimate(ivec2 coarse, vec3 x_p, vec3 n_p, float z_p);

void main() {
    ivec2 coarse = ivec2(gl_GlobalInvocationID.xy);
    if (coarse.x >= int(p.width) || coarse.y >= int(p.height)) return;
    vec4 at = texelFetch(receiver, coarse, 0);
    // Pixels without a surface are the first pass's.
    if (at.w > p.farthest || at.w <= (p.nearest > 0.0 ? p.nearest : -1.0)) return;
    vec4 result = vec4(0, 0, 0, 1);
    if (at.w > 0.0) result = estimate(coarse, position_at(coarse, at.w), at.xyz, at.w);
    imageStore(irradiance, coarse, result);
}
