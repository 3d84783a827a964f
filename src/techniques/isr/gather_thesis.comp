// SPDX-License-Identifier: MIT
// The estimate as the thesis states it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/isr/gather.glsl"

// The thesis's sums [Rohleder2010, eq. 25 and 26]: the solid angle 2 pi/N is counted besides the form factor.
vec4 estimate(ivec2 coarse, vec3 x_p, vec3 n_p, float z_p) {
    vec3 l = vec3(0);
    float blocked = 0.0;
    for (int i = 0; i < p.taps; ++i) {
        ivec2 q = coarse + ivec2(tap[i].xy);
        if (has_patch(q)) {
            vec4 x = patch_at(q);
            vec3 d = position_at(q, x.w) - x_p;
            float r2 = max(dot(d, d), 1e-12);
            float form_factor = max(dot(n_p, d), 0.0) * max(-dot(x.xyz, d), 0.0) / (PI * r2 * r2);
            l += 2.0 * PI / float(p.taps) * form_factor * source_at(q);
        }
        ivec2 o = coarse + ivec2(round(tap[i].xy * p.ao_stride));
        if (!has_patch(o)) continue;
        float z = patch_at(o).w;
        if (z <= 0.0) continue;
        vec3 d = position_at(o, z) - x_p;
        float distance = max(length(d), 1e-6);
        float r = min(p.occluder * sqrt(p.pixel_area) * z, distance);
        blocked += 2.0 * PI / float(p.taps) * (1.0 - sqrt(1.0 - (r / distance) * (r / distance))) *
                   max(dot(n_p, d / distance), 0.0);
    }
    return vec4(l, clamp(1.0 - blocked, 0.0, 1.0));
}
