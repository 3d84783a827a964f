// SPDX-License-Identifier: MIT
// Photon hit location image: where light through each pixel of a light's view ends that meets a specular object first, and
// what is left of it [Umenhoffer2009, 6.1.1].
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define SEARCH SECANT
#include "techniques/common/cube_trace.glsl"
#include "techniques/common/caustics_params.h"
#include "techniques/common/distance_cube_params.h"
#include "techniques/common/rsm_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { CausticPhotonParams p; };
layout(binding = 6) uniform sampler2D depth;
layout(binding = 7) uniform sampler2D normal;
layout(binding = 8) uniform sampler2D geometric_normal;
layout(binding = 9) uniform sampler2D diffuse;
layout(binding = 10) uniform sampler2D specular;
layout(binding = 11) uniform sampler2D direct; // a = signed_ior
layout(binding = 12, rgba32f) uniform writeonly image2D hits;   // relative to the center, m; a = 1: a photon
layout(binding = 13, rgba32f) uniform writeonly image2D powers; // W

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(p.view.width, p.view.height)))) return;
    float z = texelFetch(depth, pixel, 0).r;
    float ior = texelFetch(direct, pixel, 0).a;
    vec3 position = world_position(p.view, vec2(pixel) + 0.5, z);
    vec4 hit = vec4(0);
    vec3 power = vec3(0);
    bool mirror = ior < 0.0;
    if (z > 0.0 && ior != 0.0 && is_own(p.objects, position) && !(mirror && p.mirrored != 0u)) {
        LightSample light = sample_light(p.light, position);
        CubeRay ray;
        ray.x = position - p.cube.center;
        ray.r = -light.wi;
        ray.weight = light.irradiance * pixel_beam_area(p.view, vec2(pixel) + 0.5, position);
        ray.inside = ior > 0.0 && texelFetch(geometric_normal, pixel, 0).a < 0.0;
        ray.depth = 0;
        vec4 material = cube_material(texelFetch(diffuse, pixel, 0).rgb, texelFetch(specular, pixel, 0).rgb, ior);
        vec3 n = texelFetch(normal, pixel, 0).xyz;

        // Of two branches the stronger one, but for the first surface of what glass reflects.
        for (int i = 0; i < p.cube.depth; ++i) {
            CubeBranches b = branch(ray, ray.x, n, material, false);
            bool reflected = b.reflected.weight.g >= b.refracted.weight.g || (i == 0 && p.mirrored != 0u);
            if (reflected) ray = b.reflected;
            else ray = b.refracted;
            CubePoint to = trace_ray(p.cube, ray.x, ray.r, ray.inside);
            vec4 place = vec4(to.p, to.layer);
            material = textureLod(material_map, place, 0.0);
            if (to.layer >= p.cube.near_layers || material.a == 0.0) {
                bool there = to.met && textureLod(radiance_map, place, 0.0).a > 0.5;
                hit = vec4(to.p, there ? 1.0 : 0.0);
                power = ray.weight;
                break;
            }
            n = normalize(textureLod(normal_map, place, 0.0).xyz);
            ray.x = to.p;
        }
    }
    imageStore(hits, pixel, hit);
    imageStore(powers, pixel, vec4(power, 0));
}
