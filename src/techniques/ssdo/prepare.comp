// SPDX-License-Identifier: MIT
// The frame's images at the size that is gathered at.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/ssdo/ssdo_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { SsdoParams p; };
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D geometric_normal;
layout(binding = 3) uniform sampler2D normal;
layout(binding = 4) uniform sampler2D direct_diffuse;
layout(binding = 5, rgba32f) uniform writeonly image2D surface;  // geometric normal, depth (0 = nothing)
layout(binding = 6, rgba32f) uniform writeonly image2D receiver; // shading normal, depth
layout(binding = 7, rgba32f) uniform writeonly image2D source;   // radiance that the surface sends

void main() {
    ivec2 gathered = ivec2(gl_GlobalInvocationID.xy);
    if (gathered.x >= int(p.width) || gathered.y >= int(p.height)) return;
    ivec2 last = ivec2(p.view.width, p.view.height) - 1;
    ivec2 pixel = min(ivec2(full_pixel(vec2(gathered), p.scale)), last);
    float z = texelFetch(depth, pixel, 0).r;
    imageStore(surface, gathered, vec4(texelFetch(geometric_normal, pixel, 0).xyz, z));
    imageStore(receiver, gathered, vec4(texelFetch(normal, pixel, 0).xyz, z));
    imageStore(source, gathered, texelFetch(direct_diffuse, pixel, 0));
}
