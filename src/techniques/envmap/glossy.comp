// SPDX-License-Identifier: MIT
// What rough specular lobes reflect of an object's probe; smooth ones are for rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/frame/object_depth.glsl"
#include "techniques/envmap/envmap_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { EnvmapGatherParams p; };
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D normal;
layout(binding = 3) uniform sampler2D diffuse; // a = roughness
layout(binding = 4) uniform sampler2D specular;
layout(binding = 5) uniform sampler2D direct; // a = signed_ior
layout(binding = 6) uniform sampler2D hardware_depth;
layout(binding = 7) uniform sampler2D object_depth;
layout(binding = 8) uniform samplerCubeArray prefiltered;
layout(binding = 9) uniform sampler2D reflectance;
layout(binding = 10, rgba32f) uniform image2D radiance;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(p.view.width) || pixel.y >= int(p.view.height)) return;
    float z = texelFetch(depth, pixel, 0).r;
    if (z <= 0.0 || texelFetch(direct, pixel, 0).a != 0.0) return;
    if (!shows_object(texelFetch(object_depth, pixel, 0).r, texelFetch(hardware_depth, pixel, 0).r)) return;

    vec3 wo = -normalize(pixel_direction(p.view, vec2(pixel) + 0.5));
    vec3 n = normalize(texelFetch(normal, pixel, 0).xyz);
    float roughness = texelFetch(diffuse, pixel, 0).a;
    vec4 f = texelFetch(specular, pixel, 0);
    vec3 light = textureLod(prefiltered, vec4(reflect(-wo, n), float(p.probe)),
                            roughness * float(ENVMAP_GLOSSY_LEVELS - 1)).rgb;
    vec2 at = clamp(vec2(dot(n, wo), roughness), 0.0, 1.0);
    const float side = float(ENVMAP_REFLECTANCE);
    vec2 share = textureLod(reflectance, (at * (side - 1.0) + 0.5) / side, 0.0).rg;
    vec3 before = imageLoad(radiance, pixel).rgb;
    imageStore(radiance, pixel, vec4(before + light * (f.rgb * share.x + f.a * share.y), 1));
}
