// SPDX-License-Identifier: MIT
// Irradiance of receivers (position, normal) from a list of quads with a radiance.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/form_factor.h"
layout(local_size_x = 64) in;
layout(scalar, binding = 0) readonly buffer Quads { vec4 corner[]; };
layout(scalar, binding = 1) readonly buffer Receivers { vec4 receiver[]; };
layout(scalar, binding = 2) writeonly buffer Found { float found[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= found.length()) return;
    vec3 x = receiver[2 * i].xyz, n = receiver[2 * i + 1].xyz;
    float sum = 0.0;
    for (uint k = 0; k < corner.length(); k += 4)
        sum += corner[k].w * quad_factor_clip(Quad(corner[k].xyz - x, corner[k + 1].xyz - x,
                                                   corner[k + 2].xyz - x, corner[k + 3].xyz - x), n);
    found[i] = sum;
}
