// SPDX-License-Identifier: MIT
// Irradiance of pixels from the probe of their object, or with GRID from the eight around them. Define
// QUAD_FACTOR or POINT_FACTOR, a function of shared/form_factor.h, or CLASSIC.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/form_factor.h"
#include "techniques/frame/object_depth.glsl"
#include "techniques/envmap/envmap_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { EnvmapGatherParams p; };
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D normal;
layout(binding = 3) uniform sampler2D diffuse;
#ifdef GRID
layout(binding = 4) uniform samplerCubeArray distance_from_center;
#else
layout(binding = 4) uniform sampler2D hardware_depth;
layout(binding = 5) uniform sampler2D object_depth;
#endif
#ifdef CLASSIC
layout(binding = 6) uniform samplerCubeArray convolved;
#else
layout(binding = 6) uniform samplerBuffer list;
#endif
layout(binding = 7, rgba32f) uniform image2D radiance;

// Of a plane at x with normal n.
vec3 irradiance(int probe, vec3 x, vec3 n) {
#ifdef CLASSIC
    return textureLod(convolved, vec4(n, float(probe)), 0.0).rgb;
#else
    vec3 sum = vec3(0);
    for (int i = probe * p.senders; i < (probe + 1) * p.senders; ++i) {
#ifdef QUAD_FACTOR
        vec4 a = texelFetch(list, ENVMAP_QUAD * i), b = texelFetch(list, ENVMAP_QUAD * i + 1),
             c = texelFetch(list, ENVMAP_QUAD * i + 2), d = texelFetch(list, ENVMAP_QUAD * i + 3);
        sum += vec3(a.w, b.w, c.w) * QUAD_FACTOR(Quad(a.xyz - x, b.xyz - x, c.xyz - x, d.xyz - x), n);
#else
        vec4 a = texelFetch(list, ENVMAP_POINT * i), b = texelFetch(list, ENVMAP_POINT * i + 1);
        vec3 l = vec3(a.w, b.w, texelFetch(list, ENVMAP_POINT * i + 2).x);
        sum += l * POINT_FACTOR(a.xyz - x, b.xyz, n);
#endif
    }
    return sum;
#endif
}

#ifdef GRID
// Trilinear among the probes that see the point; among all when none does.
vec3 irradiance_here(vec3 x, vec3 n) {
    vec3 seen = vec3(0), all = vec3(0);
    float seen_weight = 0.0, weight = 0.0;
    for (int k = 0; k < 8; ++k) {
        EnvmapNeighbor at = envmap_neighbor(p, x, k);
        vec3 e = irradiance(at.probe, x, n);
        vec3 from = x - envmap_position(p, at.probe);
        // Probes farther off see the surface at a slant: a texel's slope, at 45 degrees its width.
        float surface = textureLod(distance_from_center, vec4(from, float(at.probe)), 0.0).r;
        bool visible = length(from) <= surface * (1.0 + 4.0 / float(textureSize(distance_from_center, 0).x));
        all += at.weight * e, weight += at.weight;
        if (visible) seen += at.weight * e, seen_weight += at.weight;
    }
    return seen_weight > 1e-3 ? seen / seen_weight : all / weight;
}
#else
vec3 irradiance_here(vec3 x, vec3 n) { return irradiance(p.probe, x, n); }
#endif

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(p.view.width) || pixel.y >= int(p.view.height)) return;
    float z = texelFetch(depth, pixel, 0).r;
    if (z <= 0.0) return;
#ifndef GRID
    if (!shows_object(texelFetch(object_depth, pixel, 0).r, texelFetch(hardware_depth, pixel, 0).r)) return;
#endif
    vec3 x = world_position(p.view, vec2(pixel) + 0.5, z);
    vec3 e = irradiance_here(x, normalize(texelFetch(normal, pixel, 0).xyz));
    imageStore(radiance, pixel, vec4(texelFetch(diffuse, pixel, 0).rgb / PI * e, 1));
}
