// SPDX-License-Identifier: MIT
// The published estimator [Ritschel2009]: one point on each of N uniform directions; what it lies behind is
// an occluder, a sender of the area pi r^2/N.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/ssdo/gather.glsl"

vec4 gather(Receiver r, ivec2 pixel) {
    vec3 jitter = ssdo_jitter(vec2(pixel));
    mat3 to_world = frame_around(r.normal);
    vec3 bounce = vec3(0), blocked = vec3(0);
    float open = 0.0, all = 0.0;
    float area = PI * p.radius * p.radius / float(p.samples);
    for (int i = 0; i < p.samples; ++i) {
        vec3 direction = to_world * sample_uniform_hemisphere(ssdo_sample(i, p.samples, jitter));
        float cos_r = dot(direction, r.normal);
        all += cos_r;
        float t = p.radius * fract(jitter.z + 0.61803399 * float(i));
        vec3 h = homogeneous_pixel(p.view, r.position + t * direction);
        ivec2 q = pixel_of(h);
        vec4 s = vec4(0);
        if (h.z >= p.view.near && is_inside(q)) s = texelFetch(surface, q, 0);
        vec3 to_surface = position_at(q, s.w) - r.position;
        if (s.w <= 0.0 || h.z <= s.w || !is_above(r, to_surface, s.w)) {
            open += cos_r;
            continue;
        }
        blocked += sh_radiance(p.environment, direction) * cos_r;
        float d = length(to_surface);
        float cos_s = max(-dot(s.xyz, to_surface) / d, 0.0);
        float cos_p = max(dot(r.normal, to_surface) / d, 0.0);
        // The paper's clamp of the distance to 1.
        bounce += texelFetch(source, q, 0).rgb * (area * cos_s * cos_p / max(d * d, 1.0));
    }
    vec3 e = less_blocked(bounce, blocked * (2.0 * PI / float(p.samples)), r.normal);
    return vec4(e, open / max(all, 1e-6));
}
