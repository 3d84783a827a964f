// SPDX-License-Identifier: MIT
// The texels of a probe's reduced cube as quadrilaterals with a radiance.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/cube.h"
#include "shared/form_factor.h"
#include "techniques/envmap/envmap_params.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) uniform params { EnvmapListParams p; };
layout(binding = 1) uniform samplerCube radiance;
layout(binding = 2) uniform samplerCube distance_from_center;
layout(binding = 3, scalar) writeonly buffer list { vec4 element[]; };

// A corner of the low-resolution map: its direction times its distance, filtered among the texels around it.
vec3 corner_at(vec3 direction) {
    return normalize(direction) * textureLod(distance_from_center, direction, p.distance_level).r;
}

struct Sender {
    Quad corners; // relative to the probe's center, sending toward it
    vec3 radiance;
};

Sender sender_of(int i) {
    int m = p.texels, face = i / (m * m);
    vec2 texel = vec2(i % m, (i / m) % m);
    float t = 1.0 / float(m);
    vec3 d[4] = vec3[4](cube_direction(face, texel * t), cube_direction(face, (texel + vec2(0, 1)) * t),
                        cube_direction(face, (texel + 1.0) * t), cube_direction(face, (texel + vec2(1, 0)) * t));
    Sender s;
    s.corners = Quad(corner_at(d[0]), corner_at(d[1]), corner_at(d[2]), corner_at(d[3]));

    // [Umenhoffer2009, 3.1] writes the mean of the corners, its algorithm 1 the texel.
    vec3 mean = vec3(0);
    for (int k = 0; k < 4; ++k) mean += 0.25 * textureLod(radiance, d[k], p.level).rgb;
    vec3 own = textureLod(radiance, cube_direction(face, (texel + 0.5) * t), p.level).rgb;
    s.radiance = mix(own, mean, p.corners);
    return s;
}
