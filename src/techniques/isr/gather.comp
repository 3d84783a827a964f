// SPDX-License-Identifier: MIT
// Irradiance of every coarse pixel from the patches around it, and its accessibility.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/isr/isr_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { IsrParams p; };
// A uniform block, not a storage buffer: uniformly indexed tables are 3 times faster there on CPU drivers.
layout(binding = 1) uniform taps { vec4 tap[ISR_MAX_TAPS]; }; // offset, weight in coarse pixels
layout(binding = 2) uniform sampler2D patches;
layout(binding = 3) uniform sampler2D receiver;
layout(binding = 4) uniform sampler2D source;
layout(binding = 5, rgba32f) uniform writeonly image2D irradiance; // rgb E in W/m2, a = accessibility

vec3 position_at(ivec2 coarse, float z) { return world_position(p.view, (vec2(coarse) + 0.5) * p.scale, z); }

// Monte Carlo over the kernel's pixels: E += weight * L_x * projected solid angle of x.
vec4 calibrated(ivec2 coarse, vec3 x_p, vec3 n_p) {
    // Each pixel turns the table and scales its radii (weights go with the square).
    IsrJitter jitter = isr_jitter(vec2(coarse));
    float angle = 2.0 * PI * jitter.turn;
    float stretch = exp(log(p.radius / p.inner_radius) / float(p.taps) * (jitter.shift - 0.5));
    mat2 rotate = mat2(cos(angle), sin(angle), -sin(angle), cos(angle)) * stretch;
    vec3 e = vec3(0);
    float blocked = 0.0;
    for (int i = 0; i < p.taps; ++i) {
        ivec2 q = ivec2(floor(vec2(coarse) + 0.5 + rotate * tap[i].xy));
        if (q.x < 0 || q.y < 0 || q.x >= int(p.width) || q.y >= int(p.height)) continue;
        vec4 x = texelFetch(patches, q, 0);
        vec3 to_patch = position_at(q, x.w) - x_p;
        float omega = tap[i].z * stretch * stretch * projected_solid_angle(n_p, to_patch, x.xyz);
        e += omega * texelFetch(source, q, 0).rgb;
        if (dot(to_patch, to_patch) < p.ao_radius * p.ao_radius) blocked += omega;
    }
    return vec4(e, clamp(1.0 - blocked / PI, 0.0, 1.0));
}

// The thesis's sums [Rohleder2010, eq. 25 and 26]: the solid angle 2 pi/N is counted besides the form factor.
vec4 thesis(ivec2 coarse, vec3 x_p, vec3 n_p, float z_p) {
    vec3 l = vec3(0);
    float blocked = 0.0;
    for (int i = 0; i < p.taps; ++i) {
        ivec2 q = coarse + ivec2(tap[i].xy);
        if (q.x >= 0 && q.y >= 0 && q.x < int(p.width) && q.y < int(p.height)) {
            vec4 x = texelFetch(patches, q, 0);
            vec3 d = position_at(q, x.w) - x_p;
            float r2 = max(dot(d, d), 1e-12);
            float form_factor = max(dot(n_p, d), 0.0) * max(-dot(x.xyz, d), 0.0) / (PI * r2 * r2);
            l += 2.0 * PI / float(p.taps) * form_factor * texelFetch(source, q, 0).rgb;
        }
        ivec2 o = coarse + ivec2(round(tap[i].xy * p.ao_stride));
        if (o.x < 0 || o.y < 0 || o.x >= int(p.width) || o.y >= int(p.height)) continue;
        float z = texelFetch(patches, o, 0).w;
        if (z <= 0.0) continue;
        vec3 d = position_at(o, z) - x_p;
        float distance = max(length(d), 1e-6);
        float r = min(p.occluder * sqrt(p.pixel_area) * z, distance);
        blocked += 2.0 * PI / float(p.taps) * (1.0 - sqrt(1.0 - (r / distance) * (r / distance))) *
                   max(dot(n_p, d / distance), 0.0);
    }
    return vec4(l, clamp(1.0 - blocked, 0.0, 1.0));
}

void main() {
    ivec2 coarse = ivec2(gl_GlobalInvocationID.xy);
    if (coarse.x >= int(p.width) || coarse.y >= int(p.height)) return;
    vec4 at = texelFetch(receiver, coarse, 0);
    vec4 result = vec4(0, 0, 0, 1);
    if (at.w > 0.0) {
        vec3 x_p = position_at(coarse, at.w);
        result = p.mode == ISR_THESIS ? thesis(coarse, x_p, at.xyz, at.w) : calibrated(coarse, x_p, at.xyz);
    }
    imageStore(irradiance, coarse, result);
}
