// SPDX-License-Identifier: MIT
// Draws one point into one light's map: the texels whose rays meet its disc, always the one that it is in.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/vpl_params.h"
#include "techniques/vpl/ism_params.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) uniform params { IsmParams p; };
layout(binding = 1) uniform samplerBuffer placed; // (position, radius), (normal, 0)
layout(binding = 2) uniform samplerBuffer lights;
layout(binding = 3, scalar) readonly buffer light_count { int count; };
layout(binding = 4, r32ui) uniform uimage2D nearest; // bits of 1/distance

const float WIDEST = 3.0; // texels that a disc reaches from its middle

void main() {
    int i = int(gl_GlobalInvocationID.x), light = int(gl_GlobalInvocationID.y);
    if (i >= p.points || light >= count) return;
    vec3 origin = texelFetch(lights, light * VPL_TEXELS).xyz;
    mat3 around = frame_around(texelFetch(lights, light * VPL_TEXELS + 1).xyz);
    int at = 2 * (light % p.sets * p.points + i);
    vec4 disc = texelFetch(placed, at);
    vec3 middle = (disc.xyz - origin) * around;

    // The light's own surface is no occluder.
    vec3 n = texelFetch(placed, at + 1).xyz * around;
    if (middle.z <= disc.w || n == vec3(0)) return;
    float d = length(middle);
    vec2 m = to_paraboloid(middle / d), center = (m * 0.5 + 0.5) * float(p.size);
    float texel = ism_texel(m, p.size), reach = min(disc.w / (d * texel), WIDEST);

    ivec2 own = clamp(ivec2(center), ivec2(0), ivec2(p.size - 1));
    ivec2 first = clamp(ivec2(floor(center - reach)), ivec2(0), own);
    ivec2 last = clamp(ivec2(floor(center + reach)), own, ivec2(p.size - 1));
    ivec2 corner = ism_corner(light, p);
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            // Where the texel's ray meets the disc, which is at least as large as the texel.
            bool inside = x == own.x && y == own.y;
            vec3 ray = from_paraboloid((vec2(x, y) + 0.5) * (2.0 / float(p.size)) - 1.0);
            float t = dot(n, middle) / dot(n, ray);
            float radius = inside ? disc.w + d * texel : disc.w;
            bool meets = t > 0.0 && length(t * ray - middle) <= radius;
            if (!meets && !inside) continue;
            imageAtomicMax(nearest, corner + ivec2(x, y), floatBitsToUint(1.0 / (meets ? t : d)));
        }
}
