// SPDX-License-Identifier: MIT
// G-buffer and direct light to coarse patches. `calibrated` keeps one representative surface per coarse
// pixel; `thesis` averages the buffers of the block [Rohleder2010, 4.2]. RECEIVERS: they receive light, too.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/isr/isr_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { IsrPatchParams p; };
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D geometric_normal;
layout(binding = 3) uniform sampler2D normal;
layout(binding = 4) uniform sampler2D diffuse;
layout(binding = 5) uniform sampler2D direct_diffuse;
layout(binding = 6, rgba32f) uniform writeonly image2D patches;  // area vector, depth (0 = none)
layout(binding = 7, rgba32f) uniform writeonly image2D source;   // radiance that the patch sends, a = 1 if any
#ifdef RECEIVERS
layout(binding = 8, rgba32f) uniform writeonly image2D receiver; // shading normal, depth
layout(binding = 9, rgba32f) uniform writeonly image2D albedo;   // diffuse albedo
#endif

void store(ivec2 coarse, vec4 area_and_depth, vec4 sent) {
    imageStore(patches, coarse + p.origin, area_and_depth);
    imageStore(source, coarse + p.origin, sent);
}

// Index of the nearest surface but one (the nearest where only one pixel has any); -1 = background.
int representative(float z[4], int count) {
    int first = -1, second = -1;
    for (int i = 0; i < count; ++i) {
        if (z[i] <= 0.0) continue;
        if (first < 0 || z[i] < z[first]) {
            second = first;
            first = i;
        } else if (second < 0 || z[i] < z[second]) {
            second = i;
        }
    }
    return second >= 0 ? second : first;
}

void main() {
    ivec2 coarse = ivec2(gl_GlobalInvocationID.xy);
    if (coarse.x >= int(p.width) || coarse.y >= int(p.height)) return;
    ivec2 in_hole = coarse - p.hole;
    if (all(greaterThanEqual(in_hole, ivec2(0))) && all(lessThan(in_hole, p.hole_size))) return;
    int step = int(p.scale);
    ivec2 last = ivec2(p.view.width, p.view.height) - 1;
    int count = step * step;
    ivec2 pixel[4];
    float z[4];
    for (int i = 0; i < count; ++i) {
        pixel[i] = min(coarse * step + ivec2(i % step, i / step), last);
        z[i] = texelFetch(depth, pixel[i], 0).r;
    }

    int best = representative(z, count);
    if (best < 0) {
        store(coarse, vec4(0), vec4(0));
#ifdef RECEIVERS
        imageStore(receiver, coarse, vec4(0));
        imageStore(albedo, coarse, vec4(0));
#endif
        return;
    }
    vec3 ng = texelFetch(geometric_normal, pixel[best], 0).xyz;
    vec3 ns = texelFetch(normal, pixel[best], 0).xyz;

    // Colors of the pixels that lie on the representative's surface; the thesis averages normals and depth as well.
    vec3 color = vec3(0), rho = vec3(0), n_sum = vec3(0);
    float weight = 0.0, z_sum = 0.0;
    for (int i = 0; i < count; ++i) {
        if (z[i] <= 0.0) continue;
        bool same = abs(z[i] - z[best]) < 0.1 * z[best] && dot(texelFetch(geometric_normal, pixel[i], 0).xyz, ng) > 0.7;
        if (p.mode != ISR_THESIS && !same) continue;
        color += texelFetch(direct_diffuse, pixel[i], 0).rgb;
        rho += texelFetch(diffuse, pixel[i], 0).rgb;
        n_sum += texelFetch(normal, pixel[i], 0).xyz;
        z_sum += z[i];
        weight += 1.0;
    }
    color /= weight;
    rho /= weight;

    vec2 center = p.mode == ISR_THESIS ? (vec2(coarse) + 0.5) * p.scale : vec2(pixel[best]) + 0.5;
    float z_patch = z[best];
    if (p.mode == ISR_THESIS) {
        ns = normalize(n_sum + vec3(0, 1e-6, 0));
        ng = ns;
        z_patch = z_sum / weight;
        color = rho; // the thesis's L_x is the unlit albedo buffer
    }
    // The patch is read back at the coarse pixel's center: slide it there along its own plane.
    vec3 ray = world_position(p.view, (vec2(coarse) + 0.5) * p.scale, 1.0) - p.view.position;
    vec3 ray_best = world_position(p.view, center, 1.0) - p.view.position;
    float facing = dot(ng, ray);
    if (abs(facing) > p.grazing * length(ray)) z_patch *= clamp(dot(ng, ray_best) / facing, 0.9, 1.1);
    store(coarse, vec4(patch_area_vector(ng, ray, z_patch, p.pixel_area, p.grazing), z_patch), vec4(color, 1.0));
#ifdef RECEIVERS
    imageStore(receiver, coarse, vec4(ns, z_patch));
    imageStore(albedo, coarse, vec4(rho, 1.0));
#endif
}
