// SPDX-License-Identifier: MIT
// Normal and depth of the frame, one pixel of each block in the middle.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { int step; };
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D geometric_normal;
layout(binding = 3, rgba32f) uniform writeonly image2D guide;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(guide)))) return;
    ivec2 full = min(pixel * step + step / 2, textureSize(depth, 0) - 1);
    imageStore(guide, pixel, vec4(texelFetch(geometric_normal, full, 0).xyz, texelFetch(depth, full, 0).r));
}
