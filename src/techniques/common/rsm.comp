// SPDX-License-Identifier: MIT
// Flux of a light's view: what arrives, and what the Lambertian lobe sends on.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/rsm_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { RsmParams p; };
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D diffuse;
layout(binding = 3) uniform sampler2D direct; // a = signed_ior
layout(binding = 4, rgba32f) uniform writeonly image2D flux;
layout(binding = 5, rgba32f) uniform writeonly image2D reflected;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(p.view.width) || pixel.y >= int(p.view.height)) return;
    vec2 center = vec2(pixel) + 0.5;
    float z = texelFetch(depth, pixel, 0).r;
    vec4 incident = vec4(0.0);
    if (z > 0.0)
        incident = vec4(incident_flux(p, center, world_position(p.view, center, z)),
                        texelFetch(direct, pixel, 0).a != 0.0 ? 1.0 : 0.0);
    imageStore(flux, pixel, incident);
    imageStore(reflected, pixel, vec4(incident.rgb * texelFetch(diffuse, pixel, 0).rgb, 1.0));
}
