// SPDX-License-Identifier: MIT
// Takes out of an additional camera's depth what the frame's patches show already, so that no surface sends
// twice.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/isr/view_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { IsrUnseenParams p; };
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D patches; // of the frame
layout(binding = 3, r32f) uniform writeonly image2D unseen;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(unseen)))) return;
    float z = texelFetch(depth, pixel, 0).r;
    IsrProjection at = isr_project(p.view, world_position(p.camera, vec2(pixel) + 0.5, z));
    ivec2 t = ivec2(floor(at.pixel / p.scale)) + p.origin;
    bool inside = at.depth > 0.0 && t.x >= 0 && t.y >= 0 && t.x < p.patches.x && t.y < p.patches.y;

    // Nothing lies before what the frame sees; where it sees nothing there is nothing.
    float front = texelFetch(patches, clamp(t, ivec2(0), p.patches - 1), 0).w;
    bool seen = inside && (front <= 0.0 || at.depth <= front * (1.0 + p.tolerance));
    imageStore(unseen, pixel, vec4(seen ? 0.0 : z));
}
