// SPDX-License-Identifier: MIT
// Irradiance that was splatted on fewer pixels to the frame's [Le2014, 3.3.2.4].
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/upsample.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { int step; };
layout(binding = 1) uniform sampler2D coarse;
layout(binding = 2) uniform sampler2D guide;
layout(binding = 3) uniform sampler2D depth;
layout(binding = 4) uniform sampler2D geometric_normal;
layout(binding = 5, rgba32f) uniform writeonly image2D irradiance;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(irradiance)))) return;
    float z = texelFetch(depth, pixel, 0).r;
    // Each coarse pixel shows a frame's pixel right below the middle of its block, or in it.
    vec2 at = vec2(pixel) + (step % 2 == 1 ? 0.5 : 0.0);
    vec3 n = texelFetch(geometric_normal, pixel, 0).xyz;
    vec4 e = z > 0.0 ? bilateral_upsample(coarse, guide, at, float(step), n, z) : vec4(0);
    imageStore(irradiance, pixel, vec4(e.rgb, 1));
}
