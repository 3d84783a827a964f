// SPDX-License-Identifier: MIT
// Open solid angle above the tangent plane from the horizons of a few slices [Bavoil2008].
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/horizon.glsl"
#include "techniques/hbao/hbao_params.h"

layout(binding = 0, scalar) uniform params { HbaoParams p; };

// Share of one side's half slice that is hidden: sum of W (sin h - sin t), where elevations h above and t of the
// tangent are measured from the plane across the view direction.
float hidden(Receiver x, ivec2 pixel, HorizonSlice s, float side, float shift, float reach) {
    float tangent = -side * sin(s.gamma);
    Horizon h = Horizon(0.0, min(tangent + p.bias, 1.0));
    vec2 line = s.pixels * side;
    float end = horizon_end(p.occlusion, vec2(pixel), line, reach);
    for (int k = 0; k < p.steps; ++k) {
        HorizonPoint point = horizon_point(p.occlusion, x, pixel, s, line, end * horizon_step(k, p.steps, shift));
        if (point.distance2 < 1.0) h = horizon_add(h, point, 1.0 - p.falloff * point.distance2);
    }
    return h.hidden;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, p.occlusion.size))) return;
    Receiver x = occlusion_receiver(p.occlusion, pixel);
    float open = 1.0;
    if (x.there) {
        vec2 jitter = horizon_jitter(x.pattern);
        float reach = horizon_reach(x.position, p.occlusion.radius);
        for (int i = 0; i < p.slices; ++i) {
            float turn = (float(i) + jitter.x) / float(p.slices);
            HorizonSlice s = horizon_slice(p.occlusion, x.position, x.normal, turn);
            float both = hidden(x, pixel, s, 1.0, jitter.y, reach) + hidden(x, pixel, s, -1.0, jitter.y, reach);
            open -= 0.5 * both / float(p.slices);
        }
    }
    write_accessibility(x, pixel, max(open, 0.0));
}
