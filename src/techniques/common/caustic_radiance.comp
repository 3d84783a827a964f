// SPDX-License-Identifier: MIT
// What one face of a distance cube reflects of a caustic cube map around another center.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/cube.h"
#include "techniques/common/caustics_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { CausticRadianceParams p; };
layout(binding = 1) uniform sampler2D distance_from_center; // of the face
layout(binding = 2) uniform sampler2D normal;
layout(binding = 3) uniform sampler2D material;
layout(binding = 4) uniform samplerCube distance_map;
layout(binding = 5) uniform samplerCube caustic;
layout(binding = 6, rgba32f) uniform image2D radiance;
#include "techniques/common/caustic_receive.glsl"

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(radiance);
    if (any(greaterThanEqual(texel, size))) return;
    vec4 n = texelFetch(normal, texel, 0), albedo = texelFetch(material, texel, 0);
    if (n.a < 0.5 || albedo.a != 0.0) return;
    vec3 along = normalize(cube_direction(p.face, (vec2(texel) + 0.5) / vec2(size)));
    vec3 x = p.offset + along * texelFetch(distance_from_center, texel, 0).r;
    vec3 before = imageLoad(radiance, texel).rgb;
    imageStore(radiance, texel, vec4(before + albedo.rgb / PI * caustic_irradiance(x, n.xyz, p.texel), 1));
}
