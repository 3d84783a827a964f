// SPDX-License-Identifier: MIT
// Open share of the tangent sphere's volume [Umenhoffer2009, eq. 4.6]. Each tap is a thin pyramid around a pixel's view
// ray: it is cut with the sphere and with the visible surface analytically. Deviation: the thesis's pipes are parallel to
// the view axis, which does not fit a perspective depth buffer: planes would hide part of their own spheres.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/occlusion.glsl"
#include "techniques/volumetric/volumetric_params.h"

layout(binding = 0, scalar) uniform params { VolumetricParams p; };
layout(binding = 4) uniform taps { vec4 tap[OCCLUSION_MAX_SAMPLES]; }; // points of the unit disc

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    OcclusionParams o = p.occlusion;
    if (any(greaterThanEqual(pixel, o.size))) return;
    Receiver x = occlusion_receiver(o, pixel);
    if (!x.there) {
        write_accessibility(x, pixel, 1.0);
        return;
    }

    // The sphere shrinks where it would come nearer than 45 degrees around the eye: r = z / (1 + sqrt 2).
    float r = min(0.5 * o.radius, 0.41421356 * x.position.z);
    vec3 c = x.position + x.normal * r;

    // Its outline on the plane z = 1 is an ellipse: center c.xy c.z / a, half axis r / sqrt a across the direction of
    // c.xy and sqrt(1 + s) times that along it, with a = c.z^2 - r^2 and s = |c.xy|^2 / a.
    float a = c.z * c.z - r * r;
    float s = dot(c.xy, c.xy) / a;
    float stretch = 1.0 / (a * (sqrt(1.0 + s) + 1.0));
    vec2 turn = pattern_turn(x.pattern);
    mat2 rotate = mat2(turn.x, turn.y, -turn.y, turn.x);
    mat2 to_plane = (mat2(1) + stretch * outerProduct(c.xy, c.xy)) * rotate * (r * inversesqrt(a));
    mat2 to_pixel = mat2(to_plane[0] / o.ray_scale, to_plane[1] / o.ray_scale);
    vec2 center = (c.xy * (c.z / a) - o.ray_offset) / o.ray_scale + 0.5;

    vec2 c_plane = c.xy / c.z;
    float r2 = r * r, c2 = c.z * c.z;
    float thickness = o.thickness * x.position.z * inversesqrt(dot(x.position, x.position));
    float open = 0.0, volume = 0.0;
    for (int i = 0; i < o.samples; ++i) {
        ivec2 q = occlusion_pixel(o, center + to_pixel * tap[i].xy);
        float z = occluder_depth(q) * (1.0 + exp2(-19.0)); // some 30 roundings: a plane must not hide itself

        // Entry and exit of the ray (d, 1): middle -+ half, from |t (d, 1) - c| = r, written with the difference to the
        // direction of c so that small spheres far away lose no digits.
        vec2 d = vec2(q) * o.ray_scale + o.ray_offset;
        vec2 e = d - c_plane;
        float across = c.x * e.y - c.y * e.x;
        float dd = dot(d, d) + 1.0;
        float inverse = 1.0 / dd;
        float middle = (dot(d, c.xy) + c.z) * inverse;
        float chord = sqrt(max(r2 * dd - c2 * dot(e, e) - across * across, 0.0)) * inverse;
        float entry = middle - chord, leave = middle + chord;

        // Volumes of pyramids: t^3 / 3 for a unit of the plane z = 1; solid from z to z + thickness.
        float from = clamp(z, entry, leave), to = clamp(z + thickness, entry, leave);
        float whole = 2.0 * chord * (3.0 * middle * middle + chord * chord);
        open += whole - (to - from) * (to * to + to * from + from * from);
        volume += whole;
    }

    // The thesis's constant is the sphere's volume over the area that a tap stands for; here the area is pi times the
    // half axes of the outline.
    float axes = r * r / a * sqrt(1.0 + s);
    if (p.analytic != 0u) volume = 4.0 * r * r2 * float(o.samples) / axes;
    write_accessibility(x, pixel, volume > 0.0 ? open / volume : 1.0);
}
