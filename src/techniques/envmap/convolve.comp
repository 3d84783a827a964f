// SPDX-License-Identifier: MIT
// Irradiance at the probe by normal: the cube convolved with the cosine.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/cube.h"
#include "techniques/envmap/envmap_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2DArray radiance; // the faces of one level
layout(binding = 1, rgba32f) uniform writeonly image2DArray irradiance;

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    if (texel.x >= ENVMAP_CONVOLVED || texel.y >= ENVMAP_CONVOLVED) return;
    vec3 n = normalize(cube_direction(texel.z, (vec2(texel.xy) + 0.5) / float(ENVMAP_CONVOLVED)));
    int size = textureSize(radiance, 0).x;
    vec3 sum = vec3(0);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            float solid_angle = cube_texel_solid_angle(x, y, size);
            for (int face = 0; face < 6; ++face) {
                vec3 direction = normalize(cube_direction(face, (vec2(x, y) + 0.5) / float(size)));
                sum += texelFetch(radiance, ivec3(x, y, face), 0).rgb * (max(dot(n, direction), 0.0) * solid_angle);
            }
        }
    imageStore(irradiance, texel, vec4(sum, 1));
}
