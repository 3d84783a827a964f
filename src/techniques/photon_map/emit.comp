// SPDX-License-Identifier: MIT
// First hits: one photon for each non-empty cell of the finest level of the flux pyramid that has no more of them than
// photons are wanted [Le2014, 3.3.1.1]. It starts at one of the cell's specular pixels, drawn by flux, and carries
// what all of them receive; the thesis drops cells that are specular in part.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/photon_map/photon_map_params.h"
#include "techniques/photon_map/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { PhotonEmitParams p; };
layout(binding = 1) uniform sampler2D sums;
layout(binding = 2) uniform sampler2D depth;
layout(binding = 3) uniform sampler2D normal;
layout(binding = 4) uniform sampler2D geometric_normal;
layout(binding = 5) uniform sampler2D diffuse;
layout(binding = 6) uniform sampler2D specular;
layout(binding = 7) uniform sampler2D direct; // a = signed_ior
layout(binding = 8, scalar) buffer counts { uint count_of[]; };
layout(binding = 9, scalar) writeonly buffer photons { Photon photon_of[]; };

float strength(vec3 flux) { return dot(flux, vec3(0.2126, 0.7152, 0.0722)); }

void send(Photon photon, Scattered to) {
    if (max(to.weight.r, max(to.weight.g, to.weight.b)) <= 0.0) return;
    photon.direction = to.direction;
    photon.power *= to.weight;
    photon.inside = to.inside ? 1u : 0u;
    uint index = atomicAdd(count_of[PHOTON_COUNT], 1u);
    if (index < uint(p.capacity)) photon_of[index] = photon;
}

// A pixel of the cell, with a chance proportional to its flux: from level to level, the random number used up on the way.
ivec2 draw_pixel(ivec2 cell, int level, float u) {
    while (level > 0) {
        --level;
        cell *= 2;
        float share[4], all = 0.0;
        for (int i = 0; i < 4; ++i) {
            share[i] = strength(texelFetch(sums, cell + ivec2(i & 1, i >> 1), level).rgb);
            all += share[i];
        }
        float left = u * all;
        int drawn = 0;
        while (drawn < 3 && (left >= share[drawn] || share[drawn] <= 0.0)) left -= share[drawn++];
        while (drawn > 0 && share[drawn] <= 0.0) --drawn; // what rounding has left over
        u = clamp(left / max(share[drawn], 1e-30), 0.0, 0.999999);
        cell += ivec2(drawn & 1, drawn >> 1);
    }
    return cell;
}

void main() {
    int level = 0;
    while (level + 1 < p.levels && count_of[PHOTON_LEVELS + level] > uint(p.most)) ++level;
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, textureSize(sums, level)))) return;
    vec4 sum = texelFetch(sums, cell, level);
    if (sum.a == 0.0 || (p.mixed == 0u && sum.a < float(1 << (2 * level)))) return;
    uint key = uint(cell.y) * uint(p.view.width) + uint(cell.x);
    vec3 u = random3(key, 0u, p.seed);
    ivec2 pixel = draw_pixel(cell, level, u.z);

    // What is left of the light, and how wide the part of it is that the cell stands for.
    vec3 flux = texelFetch(sums, pixel, 0).rgb;
    float pixels = strength(sum.rgb) / strength(flux);
    vec3 position = world_position(p.view, vec2(pixel) + 0.5, texelFetch(depth, pixel, 0).r);
    LightSample light = sample_light(p.light, position);
    bool parallel = p.light.type == LIGHT_DIRECTIONAL;
    Photon photon;
    photon.position = position - p.center;
    photon.state = PHOTON_FLYING;
    photon.power = flux * pixels;
    photon.travelled = parallel ? 0.0 : light.distance;
    photon.beam = pixels * strength(flux) / max(strength(light.irradiance), 1e-30);
    if (!parallel) photon.beam /= light.distance * light.distance;
    photon.parallel = parallel ? 1u : 0u;

    float ior = texelFetch(direct, pixel, 0).a;
    vec3 n = texelFetch(normal, pixel, 0).xyz, d = -light.wi;
    if (ior <= 0.0) {
        vec4 f = texelFetch(specular, pixel, 0);
        send(photon, reflect_photon(d, n, f.rgb, f.a, texelFetch(diffuse, pixel, 0).a, u.xy));
        return;
    }
    bool inside = texelFetch(geometric_normal, pixel, 0).a < 0.0 && ior < THIN_IOR;
    float reflectance = glass_reflectance(d, n, ior, inside);
    Scattered mirrored = mirrored_by_glass(d, n, inside), refracted = refracted_by_glass(d, n, ior, inside);
    if (p.both != 0u) {
        mirrored.weight *= reflectance;
        refracted.weight *= 1.0 - reflectance;
        send(photon, mirrored);
        send(photon, refracted);
    } else if (u.x < reflectance) {
        send(photon, mirrored);
    } else {
        send(photon, refracted);
    }
}
