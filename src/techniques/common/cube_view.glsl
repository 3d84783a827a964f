// SPDX-License-Identifier: MIT
// What mirrors and glass show, from the G-buffer on by rays through a layered distance cube [Umenhoffer2009, alg. 3].
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/cube_trace.glsl"
#include "techniques/common/distance_cube_params.h"
#include "techniques/common/cube_view_params.h"
#include "techniques/frame/compose_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { CubeViewParams p; };
layout(binding = 6) uniform sampler2D depth;
layout(binding = 7) uniform sampler2D normal;
layout(binding = 8) uniform sampler2D geometric_normal;
layout(binding = 9) uniform sampler2D diffuse;
layout(binding = 10) uniform sampler2D specular;
layout(binding = 11) uniform sampler2D direct; // a = signed_ior
layout(binding = 12, rgba32f) uniform image2D sum;
layout(binding = 13) uniform sampler2D environment;
#include "techniques/frame/sky.glsl"

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(p.view.width, p.view.height)))) return;
    float z = texelFetch(depth, pixel, 0).r;
    float ior = texelFetch(direct, pixel, 0).a;
    if (z <= 0.0 || ior == 0.0) return;
    vec3 position = world_position(p.view, vec2(pixel) + 0.5, z);
    if (!is_own(p.objects, position)) return;

    CubeRay ray;
    ray.x = position - p.cube.center;
    ray.r = normalize(pixel_direction(p.view, vec2(pixel) + 0.5));
    ray.weight = vec3(1);
    ray.inside = ior > 0.0 && texelFetch(geometric_normal, pixel, 0).a < 0.0;
    ray.depth = 0;
    vec4 material = cube_material(texelFetch(diffuse, pixel, 0).rgb, texelFetch(specular, pixel, 0).rgb, ior);
    vec3 n = texelFetch(normal, pixel, 0).xyz;

    // Depth first: what waits is at most one ray for each surface behind the present one.
    CubeRay waiting[CUBE_VIEW_MAX_DEPTH + 1];
    int count = 0;
    vec3 found = vec3(0);
    bool at_surface = true;
    for (;;) {
        if (at_surface) {
            CubeBranches b = branch(ray, ray.x, n, material, true);
            float reflected = max(b.reflected.weight.r, max(b.reflected.weight.g, b.reflected.weight.b));
            float refracted = max(b.refracted.weight.r, max(b.refracted.weight.g, b.refracted.weight.b));
            bool one = p.both == 0u;
            if (reflected > p.least_weight && !(one && reflected < refracted)) waiting[count++] = b.reflected;
            if (refracted > p.least_weight && !(one && reflected >= refracted)) waiting[count++] = b.refracted;
        }
        if (count == 0) break;
        ray = waiting[--count];

        CubePoint hit = trace_ray(p.cube, ray.x, ray.r, ray.inside);
        if (hit.escaped) {
            found += ray.weight * sky_radiance(environment, ray.r, p.environment_rotation, p.environment_scale);
            at_surface = false;
            continue;
        }
        vec4 place = vec4(hit.p, hit.layer);
        material = textureLod(material_map, place, 0.0);
        at_surface = hit.layer < p.cube.near_layers && material.a != 0.0;
        if (!at_surface) found += ray.weight * textureLod(radiance_map, place, 0.0).rgb;
        if (ray.depth >= p.cube.depth) at_surface = false;
        n = normalize(textureLod(normal_map, place, 0.0).xyz);
        ray.x = hit.p;
    }
    imageStore(sum, pixel, vec4(imageLoad(sum, pixel).rgb + found, 1));
}
