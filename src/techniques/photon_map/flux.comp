// SPDX-License-Identifier: MIT
// Flux that meets specular surfaces, for each pixel of a reflective shadow map, and their count.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/photon_map/photon_map_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D flux; // a = specular
layout(binding = 1, rgba32f) uniform writeonly image2D sums; // W; a = pixels
layout(binding = 2, scalar) buffer counts { uint count_of[]; };

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(sums)))) return;
    bool padding = any(greaterThanEqual(pixel, textureSize(flux, 0)));
    vec4 here = padding ? vec4(0) : texelFetch(flux, pixel, 0);
    bool sends = here.a > 0.5 && max(here.r, max(here.g, here.b)) > 0.0;
    imageStore(sums, pixel, sends ? vec4(here.rgb, 1.0) : vec4(0));
    if (sends) atomicAdd(count_of[PHOTON_LEVELS], 1u);
}
