// SPDX-License-Identifier: MIT
// The next finer level inside of each cell that has data: parabolas through it and the cells beside it, of 3x3,
// that lie on the same surface and have data [Le2014, alg. 3.2, there weighted means].
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/vpl/vpl_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { VplRegionParams p; };
layout(binding = 1) uniform sampler2D least; // of this level
layout(binding = 2) uniform sampler2D most;
layout(binding = 3) uniform sampler2D coarse; // a = 1 where there is data
layout(binding = 4, rgba32f) uniform writeonly image2D fine;

struct Place {
    vec3 position, normal;
};

// Middle of a cell without discontinuities.
Place place_of(ivec2 cell) {
    vec4 surface = 0.5 * (texelFetch(least, cell, 0) + texelFetch(most, cell, 0)); // normal, depth
    float side = float(1 << p.level);
    return Place(world_position(p.view, (vec2(cell) + 0.5) * side, surface.w), normalize(surface.xyz));
}

// As far as a surface may bend within a region.
bool same_surface(Place a, Place b) {
    vec3 n = abs(a.normal - b.normal), d = b.position - a.position;
    return max(max(n.x, n.y), n.z) <= p.normal_step && abs(dot(a.normal, d)) <= p.normal_step * length(d);
}

// A neighbor's difference to the middle, a = 1 where it counts.
vec4 step_to(ivec2 cell, ivec2 offset, vec3 middle, Place here) {
    ivec2 q = cell + offset;
    if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, textureSize(coarse, 0)))) return vec4(0);
    vec4 e = texelFetch(coarse, q, 0);
    if (e.a <= 0.0 || !same_surface(here, place_of(q))) return vec4(0);
    return vec4(e.rgb - middle, 1);
}

// Along one axis at t: a parabola through both neighbors, a line through one.
vec3 along(vec4 before, vec4 after, float t) {
    float share = 1.0 / max(before.a + after.a, 1.0);
    vec3 slope = (after.rgb - before.rgb) * share;
    vec3 curve = before.a * after.a * 0.5 * (after.rgb + before.rgb);
    return slope * t + curve * (t * t);
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, textureSize(coarse, 0)))) return;
    vec4 e = texelFetch(coarse, cell, 0);
    if (e.a <= 0.0) return; // its parts are shaded by themselves

    Place here = place_of(cell);
    vec4 left = step_to(cell, ivec2(-1, 0), e.rgb, here), right = step_to(cell, ivec2(1, 0), e.rgb, here);
    vec4 above = step_to(cell, ivec2(0, -1), e.rgb, here), below = step_to(cell, ivec2(0, 1), e.rgb, here);
    for (int k = 0; k < 4; ++k) {
        ivec2 s = ivec2(2 * (k & 1) - 1, k - (k & 1) - 1);
        vec3 value = e.rgb + along(left, right, 0.25 * float(s.x)) +
                     along(above, below, 0.25 * float(s.y));

        // The twist of the quadrant.
        vec4 x = (k & 1) == 0 ? left : right, y = k < 2 ? above : below;
        if (x.a * y.a > 0.0) {
            vec4 corner = step_to(cell, s, e.rgb, here);
            value += corner.a * 0.0625 * (corner.rgb - x.rgb - y.rgb);
        }
        imageStore(fine, 2 * cell + ivec2(k & 1, k >> 1), vec4(max(value, vec3(0)), 1));
    }
}
