// SPDX-License-Identifier: MIT
// A picture that names its pixels: x, y, scale, 1.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar, binding = 0) uniform Params { float scale; } params;
layout(binding = 1, rgba32f) writeonly uniform image2D picture;
void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, imageSize(picture)))) return;
    imageStore(picture, p, vec4(params.scale * vec2(p), params.scale, 1.0));
}
