// SPDX-License-Identifier: MIT
// Visible points, evenly over the image, as virtual point lights whose flux is their albedo; 0 where nothing is seen.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/vpl/importance_params.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) uniform params { VplEyeParams p; };
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D geometric_normal;
layout(binding = 3) uniform sampler2D diffuse;
layout(binding = 4, scalar) writeonly buffer eyes { vec4 texel_of[]; };
layout(binding = 5, scalar) writeonly buffer eye_count { int count; };

void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i == 0) count = p.points;
    if (i >= p.points) return;
    vec2 size = vec2(p.view.width, p.view.height);
    ivec2 pixel = min(ivec2((hammersley(uint(i), uint(p.points)) + vec2(0.5 / float(p.points), 0.0)) * size), ivec2(size) - 1);
    float z = texelFetch(depth, pixel, 0).r;
    vec3 normal = z > 0.0 ? normalize(texelFetch(geometric_normal, pixel, 0).xyz) : vec3(0, 1, 0);
    texel_of[i * VPL_TEXELS] = vec4(world_position(p.view, vec2(pixel) + 0.5, z), 0.0);
    texel_of[i * VPL_TEXELS + 1] = vec4(normal, 0);
    texel_of[i * VPL_TEXELS + 2] = vec4(z > 0.0 ? texelFetch(diffuse, pixel, 0).rgb : vec3(0), 0);
}
