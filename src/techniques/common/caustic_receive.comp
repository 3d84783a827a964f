// SPDX-License-Identifier: MIT
// What visible surfaces reflect of a caustic cube map, where they are what its center sees [Umenhoffer2009, 6.1.3].
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/caustics_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { CausticReceiveParams p; };
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D geometric_normal;
layout(binding = 3) uniform sampler2D diffuse;
layout(binding = 4) uniform samplerCube distance_map;
layout(binding = 5) uniform samplerCube caustic;
layout(binding = 6, rgba32f) uniform image2D radiance;

// Irradiance at x, relative to the center, on a surface with normal n: 0 where x is not what the center sees. texel: of the
// distance map, radians.
vec3 caustic_irradiance(vec3 x, vec3 n, float texel) {
    float distance = length(x), facing = abs(dot(n, x)) / distance;

    // On one surface the distance changes by this much over two texels.
    float tolerance = 0.01 + 2.0 * texel / max(facing, 0.05);
    if (abs(distance / textureLod(distance_map, x, 0.0).r - 1.0) > tolerance) return vec3(0);
    return textureLod(caustic, x, 0.0).rgb;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(p.view.width, p.view.height)))) return;
    float z = texelFetch(depth, pixel, 0).r;
    if (z <= 0.0) return;
    vec3 x = world_position(p.view, vec2(pixel) + 0.5, z) - p.center;
    vec3 irradiance = caustic_irradiance(x, texelFetch(geometric_normal, pixel, 0).xyz, p.texel);
    vec3 reflected = texelFetch(diffuse, pixel, 0).rgb / PI * irradiance;
    imageStore(radiance, pixel, imageLoad(radiance, pixel) + vec4(reflected, 0));
}
