// SPDX-License-Identifier: MIT
// Share of points in the ball around a pixel's surface that pass the depth test [Mittring2007]. Half of the ball is below
// an open plane, which therefore comes out middle gray.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/occlusion.glsl"
#include "techniques/ssao/ssao_params.h"

layout(binding = 0, scalar) uniform params { SsaoParams p; };
layout(binding = 4) uniform taps { vec4 tap[OCCLUSION_MAX_SAMPLES]; }; // points of the unit ball

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    OcclusionParams o = p.occlusion;
    if (any(greaterThanEqual(pixel, o.size))) return;
    Receiver x = occlusion_receiver(o, pixel);
    if (!x.there) {
        write_accessibility(x, pixel, 1.0);
        return;
    }

    // Taps mirrored at the pattern's plane, as the original does, scaled to meters, in homogeneous pixel coordinates.
    vec3 m = pattern_direction(x.pattern);
    mat3 mirror = (mat3(1) - 2.0 * outerProduct(m, m)) * o.radius;
    vec3 base = to_pixel(o, x.position);
    mat3 frame = mat3(to_pixel(o, mirror[0]), to_pixel(o, mirror[1]), to_pixel(o, mirror[2]));

    float thickness = o.thickness * x.position.z * inversesqrt(dot(x.position, x.position));
    float open = 0.0;
    for (int i = 0; i < o.samples; ++i) {
        vec3 h = base + frame * tap[i].xyz;
        ivec2 q = occlusion_pixel(o, h.xy / h.z + 0.5);
        float z = occluder_depth(q);
        bool hidden = z < h.z && h.z < z + thickness;
        open += hidden ? 0.0 : 1.0;
    }
    write_accessibility(x, pixel, open / float(o.samples));
}
