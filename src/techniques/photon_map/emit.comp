// SPDX-License-Identifier: MIT
// One photon for each picked cell. It starts half way through the cell's flux, which keeps photons on a regular grid, and
// carries all of it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/photon_map/photon_map_params.h"
#include "techniques/photon_map/surface.glsl"

layout(local_size_x = 64) in; // PHOTON_GROUP
layout(binding = 0, scalar) uniform params { PhotonEmitParams p; };
layout(binding = 1) uniform sampler2D sums;
layout(binding = 2) uniform sampler2D depth;
layout(binding = 3) uniform sampler2D normal;
layout(binding = 4) uniform sampler2D geometric_normal;
layout(binding = 5) uniform sampler2D diffuse;
layout(binding = 6) uniform sampler2D specular;
layout(binding = 7) uniform sampler2D direct; // a = signed_ior
layout(binding = 8, scalar) buffer counts { uint count_of[]; };
layout(binding = 10, scalar) readonly buffer picked { PickedCells cells; uint cell_of[]; };
layout(binding = 9, scalar) writeonly buffer photons { Photon photon_of[]; };

float strength(vec3 flux) { return dot(flux, vec3(0.2126, 0.7152, 0.0722)); }

// The ray that ideal surfaces send from a pixel's center.
struct Sent {
    vec3 position, normal, direction;
    bool there;
};
Sent sent_from(ivec2 pixel, bool refracts) {
    Sent s;
    ivec2 inside_image = clamp(pixel, ivec2(0), ivec2(p.view.width, p.view.height) - 1);
    s.there = pixel == inside_image && texelFetch(sums, inside_image, 0).a > 0.0;
    pixel = inside_image;
    s.position = world_position(p.view, vec2(pixel) + 0.5, texelFetch(depth, pixel, 0).r);
    s.normal = texelFetch(normal, pixel, 0).xyz;
    vec3 d = -sample_light(p.light, s.position).wi;
    float ior = texelFetch(direct, pixel, 0).a;
    bool inside = texelFetch(geometric_normal, pixel, 0).a < 0.0 && ior < THIN_IOR;
    s.direction = refracts ? refracted_by_glass(d, s.normal, ior, inside).direction : reflect(d, s.normal);
    return s;
}

// Differences to the next pixel on the same smooth surface, to one side or the other; there = false: none.
Sent difference(Sent here, ivec2 pixel, ivec2 step, bool refracts) {
    for (int side = 1; side >= -1; side -= 2) {
        Sent next = sent_from(pixel + side * step, refracts);
        vec3 way = next.position - here.position;
        bool smooth_way = next.there && dot(next.normal, here.normal) > 0.8 &&
                          abs(dot(way, here.normal)) < 0.5 * length(way) && dot(next.direction, next.direction) > 0.0;
        if (smooth_way)
            return Sent(way * float(side), vec3(0), (next.direction - here.direction) * float(side), true);
    }
    return Sent(vec3(0), vec3(0), vec3(0), false);
}

// width: pixels a side of the square that the photon stands for.
void find_neighbors(ivec2 pixel, bool refracts, float width, inout Photon photon) {
    Sent here = sent_from(pixel, refracts);
    Sent x = difference(here, pixel, ivec2(1, 0), refracts), y = difference(here, pixel, ivec2(0, 1), refracts);
    photon.differential = x.there && y.there ? 1u : 0u;
    photon.place_x = x.position * width;
    photon.turn_x = x.direction * width;
    photon.place_y = y.position * width;
    photon.turn_y = y.direction * width;
}

// width = 0: a lobe, whose directions are not the neighbors'.
void send(Photon photon, Scattered to, ivec2 pixel, bool refracts, float width) {
    if (max(to.weight.r, max(to.weight.g, to.weight.b)) <= 0.0) return;
    photon.direction = to.direction;
    photon.key = hash2(photon.key, refracts ? 1u : 0u);
    photon.power *= to.weight;
    if (p.differential == 0u || width <= 0.0) photon.differential = 0u;
    else find_neighbors(pixel, refracts, width, photon);
    photon.inside = to.inside ? 1u : 0u;
    uint index = atomicAdd(count_of[PHOTON_COUNT], 1u);
    if (index < uint(p.capacity)) photon_of[index] = photon;
}

// The pixel of the cell that has a share u of its flux before it, from level to level.
ivec2 pixel_at_share(ivec2 cell, int level, float u) {
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
    uint place = gl_GlobalInvocationID.x;
    if (place + 1u >= cells.end) return;
    ivec2 cell = ivec2(cell_of[place] & 0xFFFFu, cell_of[place] >> 16);
    vec4 sum = texelFetch(sums, cell, cells.level);
    uint key = uint(cell.y) * uint(p.view.width) + uint(cell.x);
    vec3 u = random3(key, 0u, p.seed);
    ivec2 pixel = pixel_at_share(cell, cells.level, 0.5);

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
    photon.key = hash2(key, p.seed);

    float ior = texelFetch(direct, pixel, 0).a, width = sqrt(pixels);
    vec3 n = texelFetch(normal, pixel, 0).xyz, d = -light.wi;
    if (ior <= 0.0) {
        vec4 f = texelFetch(specular, pixel, 0);
        float roughness = texelFetch(diffuse, pixel, 0).a;
        send(photon, reflect_photon(d, n, f.rgb, f.a, roughness, u.xy), pixel, false, roughness > 0.0 ? 0.0 : width);
        return;
    }
    bool inside = texelFetch(geometric_normal, pixel, 0).a < 0.0 && ior < THIN_IOR;
    float reflectance = glass_reflectance(d, n, ior, inside);
    Scattered mirrored = mirrored_by_glass(d, n, inside), refracted = refracted_by_glass(d, n, ior, inside);
    if (p.both != 0u) {
        mirrored.weight *= reflectance;
        refracted.weight *= 1.0 - reflectance;
        send(photon, mirrored, pixel, false, width);
        send(photon, refracted, pixel, true, width);
    } else if (u.x < reflectance) {
        send(photon, mirrored, pixel, false, width);
    } else {
        send(photon, refracted, pixel, true, width);
    }
}
