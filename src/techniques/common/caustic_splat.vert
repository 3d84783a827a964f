// SPDX-License-Identifier: MIT
// A photon as a square of texels of a face of the caustic cube map: six vertices for each pixel of the photon image.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/caustics_params.h"

layout(set = 0, binding = 0, scalar) uniform params { CausticFaceParams p; };
layout(set = 0, binding = 1) uniform sampler2D hits;
layout(set = 0, binding = 2) uniform sampler2D powers; // W; a: m2 that it covers at least
layout(set = 0, binding = 3) uniform samplerCube normal_map;
layout(location = 0) out vec2 offset;            // from the photon, in radii
layout(location = 1) flat out vec3 irradiance;   // at the photon, for a kernel of 1 per texel
layout(location = 2) flat out float radius;      // texels

void main() {
    int photon = gl_VertexIndex / 6;
    int corner = gl_VertexIndex % 6;
    ivec2 pixel = ivec2(photon % p.photons, photon / p.photons);
    vec4 hit = texelFetch(hits, pixel, 0);
    vec4 power = texelFetch(powers, pixel, 0);
    vec4 at = p.to_clip * vec4(hit.xyz, 1.0);
    gl_Position = vec4(2.0, 2.0, 0.5, 1.0);
    offset = vec2(0);
    irradiance = vec3(0);
    radius = p.radius;
    if (hit.a < 0.5 || max(power.r, max(power.g, power.b)) <= 0.0 || at.w <= 1e-3 * length(hit.xyz)) return;

    // A texel at the photon's place on this face, whose solid angle falls with the cube of its distance from the center.
    float texel = 2.0 / float(p.size); // of clip space
    float slant = length(vec3(at.xy / at.w, 1.0));
    vec3 n = normalize(textureLod(normal_map, hit.xyz, 0.0).xyz);
    float area = texel_area(hit.xyz, n, texel * texel / (slant * slant * slant));
    irradiance = power.rgb / area;
    radius = clamp(sqrt(power.a / (PI * area)), p.radius, max(p.radius, CAUSTIC_WIDEST));

    vec2 sides = corner == 0 ? vec2(-1, -1) : corner == 1 || corner == 3 ? vec2(1, -1)
               : corner == 2 || corner == 5 ? vec2(-1, 1) : vec2(1, 1);
    gl_Position = vec4(at.xy / at.w + sides * (radius * texel), 0.5, 1.0);
    offset = sides;
}
