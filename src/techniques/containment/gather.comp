// SPDX-License-Identifier: MIT
// Share of points in the hemisphere that are outside of all objects [Umenhoffer2009, eq. 4.5].
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/sampling.h"
#include "techniques/common/occlusion.glsl"
#include "techniques/containment/containment_params.h"

layout(binding = 0, scalar) uniform params { ContainmentParams p; };
layout(binding = 4) uniform taps { vec4 tap[OCCLUSION_MAX_SAMPLES]; }; // direction times distance, z = normal, radii

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    OcclusionParams o = p.occlusion;
    if (any(greaterThanEqual(pixel, o.size))) return;
    Receiver x = occlusion_receiver(o, pixel);
    if (!x.there) {
        write_accessibility(x, pixel, 1.0);
        return;
    }

    // Taps turned around the normal, scaled to meters, in homogeneous pixel coordinates.
    vec2 turn = pattern_turn(x.pattern) * o.radius;
    mat3 around = frame_around(x.normal);
    mat3 frame = mat3(around[0] * turn.x + around[1] * turn.y, around[1] * turn.x - around[0] * turn.y,
                      around[2] * o.radius);
    vec3 base = to_pixel(o, x.position);
    frame = mat3(to_pixel(o, frame[0]), to_pixel(o, frame[1]), to_pixel(o, frame[2]));

    // Height above the tangent plane of a point at depth z on pixel q's ray: z (slope . q + level) - height of x.
    float plane = dot(x.normal, x.position);
    vec2 slope = x.normal.xy * o.ray_scale;
    float level = dot(x.normal.xy, o.ray_offset) + x.normal.z;

    // The normal's 11 bits tilt its plane; a point slides at most by the pixel's footprint.
    float distance = length(x.position);
    float footprint = x.position.z * abs(o.ray_scale.y) * distance / max(-plane, 0.05 * distance);
    plane += exp2(-10.0) * (o.radius + footprint);

    float thickness = o.thickness * x.position.z / distance;
    float open = 0.0;
    for (int i = 0; i < o.samples; ++i) {
        vec3 h = base + frame * tap[i].xyz;
        ivec2 q = occlusion_pixel(o, h.xy / h.z + 0.5);
        float z = occluder_depth(q);

        // The depth is that of the pixel's center, not of the point's own ray. The point slides to that ray at its height
        // above the tangent plane, so that a plane hides none of its own points.
        float facing = dot(slope, vec2(q)) + level;
        float above = z * facing - plane - tap[i].z * o.radius;
        bool hidden = (facing < 0.0 ? above > 0.0 : z < h.z) && h.z < z + thickness;
        open += hidden ? 0.0 : 1.0;
    }
    write_accessibility(x, pixel, open / float(o.samples));
}
