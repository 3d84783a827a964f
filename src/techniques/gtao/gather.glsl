// SPDX-License-Identifier: MIT
// Openness from the horizons of a few slices [Jimenez2016]. With BENT also the mean open direction.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/horizon.glsl"
#include "techniques/gtao/gtao_params.h"

layout(binding = 0, scalar) uniform params { GtaoParams p; };
#ifdef BENT
layout(binding = 4, rgba32f) uniform writeonly image2D bent; // not normalized, camera space; a = depth
#endif

// Angle from the view direction to the horizon on one side.
float horizon(Receiver x, ivec2 pixel, HorizonSlice s, float side, float shift, float reach) {
    float tangent = -side * sin(s.gamma);
    Horizon h = Horizon(tangent, tangent);
    vec2 line = s.pixels * side;
    float end = horizon_end(p.occlusion, vec2(pixel), line, reach);
    for (int k = 0; k < p.steps; ++k) {
        HorizonPoint point = horizon_point(p.occlusion, x, pixel, s, line, end * horizon_step(k, p.steps, shift));
        if (point.distance2 < 1.0) h = horizon_add(h, point, 1.0);
    }
    return acos(clamp(h.hidden, -1.0, 1.0));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, p.occlusion.size))) return;
    Receiver x = occlusion_receiver(p.occlusion, pixel);
    float open = 1.0;
    vec3 direction = vec3(0);
    if (x.there) {
        vec2 jitter = horizon_jitter(x.pattern);
        float reach = horizon_reach(x.position, p.occlusion.radius);
        for (int i = 0; i < p.slices; ++i) {
            float turn = (float(i) + jitter.x) / float(p.slices);
            HorizonSlice s = horizon_slice(p.occlusion, x.position, x.normal, turn);
            float ahead = horizon(x, pixel, s, 1.0, jitter.y, reach);
            float behind = horizon(x, pixel, s, -1.0, jitter.y, reach);
            // Less what is hidden, not the sum of what is open: a slice's open share is 1 in the mean only.
            float all = cos(s.gamma) + s.gamma * sin(s.gamma);
            float seen = gtao_arc(ahead, s.gamma) + gtao_arc(behind, -s.gamma);
            open -= s.weight * (all - seen) / float(p.slices);
#ifdef BENT
            vec2 a = gtao_bent_arc(ahead, s.gamma), b = gtao_bent_arc(behind, -s.gamma);
            vec2 whole = gtao_bent_arc(0.5 * PI + s.gamma, s.gamma), half_whole = gtao_bent_arc(0.5 * PI - s.gamma, -s.gamma);
            vec2 hidden = vec2(whole.x - half_whole.x - a.x + b.x, whole.y + half_whole.y - a.y - b.y);
            direction -= s.weight * (hidden.x * s.tangent + hidden.y * s.view) / float(p.slices);
#endif
        }
    }
    write_accessibility(x, pixel, open);
#ifdef BENT
    // The mean direction of the open hemisphere is 2/3 of the normal.
    imageStore(bent, pixel, vec4(direction + 2.0 / 3.0 * x.normal, x.there ? x.position.z : 0.0));
#endif
}
