// SPDX-License-Identifier: MIT
// The physical estimate over log-polar taps.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/isr/gather.glsl"

// Monte Carlo over the kernel's pixels: E += weight * L_x * projected solid angle of x.
vec4 estimate(ivec2 coarse, vec3 x_p, vec3 n_p, float z_p) {
    // Each pixel turns the table and scales its radii (weights go with the square).
    IsrJitter jitter = isr_jitter(vec2(coarse));
    float angle = 2.0 * PI * fract(jitter.turn + p.turn);
    float shift = fract(jitter.shift + p.shift);
    float stretch = exp(log(p.radius / p.inner_radius) / float(p.taps) * (shift - 0.5));
    mat2 rotate = mat2(cos(angle), sin(angle), -sin(angle), cos(angle)) * stretch;
    vec3 e = vec3(0);
    float blocked = 0.0;
    for (int i = 0; i < p.taps; ++i) {
        ivec2 q = ivec2(floor(vec2(coarse) + 0.5 + rotate * tap[i].xy));
        if (!has_patch(q)) continue;
        vec4 x = patch_at(q);
        vec3 to_patch = position_at(q, x.w) - x_p;
        float omega = tap[i].z * stretch * stretch * projected_solid_angle(n_p, to_patch, x.xyz);
        e += omega * source_at(q);
        if (dot(to_patch, to_patch) < p.ao_radius * p.ao_radius) blocked += omega;
    }
    return vec4(e, clamp(1.0 - blocked / PI, 0.0, 1.0));
}
