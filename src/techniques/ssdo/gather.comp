// SPDX-License-Identifier: MIT
// Monte Carlo over cosine-distributed directions: each is followed through the depth buffer to its first
// occluder within the radius, which sends its light and hides the environment.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/ssdo/gather.glsl"

struct Occluder {
    ivec2 pixel; // x = -1: none
    float t;     // where the ray meets its plane; -1: the ray passes behind it
};

// A ray meets a surface between two of its points when it crosses the plane of what the second one's pixel
// shows. One that comes out behind what is seen has gone through a side that is hidden: up to the thickness
// that is blocked too.
Occluder march(Receiver r, vec3 direction, float shift) {
    vec3 from = homogeneous_pixel(p.view, r.position);
    vec3 along = homogeneous_pixel(p.view, r.position + direction) - from;
    float length = length_in_view(p.view, from, along, p.radius), before = 0.0;
    for (int k = 0; k < p.steps; ++k) {
        float t = ssdo_distance(k, p.steps, shift, length);
        vec3 h = from + t * along;
        ivec2 q = pixel_of(h);
        vec4 s = texelFetch(surface, q, 0);
        vec3 to_surface = position_at(q, s.w) - r.position;
        float facing = dot(s.xyz, direction), plane = dot(s.xyz, to_surface);
        // t_plane = plane/facing, before <= t_plane < t, with both signs negative
        bool crosses = facing < 0.0 && plane <= before * facing && plane > t * facing;
        bool behind = h.z > s.w && h.z - s.w < p.thickness * t;
        if (s.w > 0.0 && (crosses || behind) && is_above(r, to_surface, s.w))
            return Occluder(q, crosses ? plane / facing : -1.0);
        before = t;
    }
    return Occluder(ivec2(-1), -1.0);
}

// Light of the occluder where the ray meets it, or of the pixel that it was found at, where that point is
// hidden.
vec3 light_of(Receiver r, vec3 direction, Occluder o) {
    vec3 h = homogeneous_pixel(p.view, r.position + o.t * direction);
    ivec2 q = pixel_of(h);
    if (!is_inside(q) || abs(texelFetch(surface, q, 0).w - h.z) > 0.02 * h.z) q = o.pixel;
    return texelFetch(source, q, 0).rgb;
}

vec4 gather(Receiver r, ivec2 pixel) {
    vec3 jitter = ssdo_jitter(vec2(pixel));
    mat3 to_world = frame_around(r.normal);
    vec3 bounce = vec3(0), blocked = vec3(0);
    float open = 0.0;
    for (int i = 0; i < p.samples; ++i) {
        vec3 direction = to_world * sample_cosine_hemisphere(ssdo_sample(i, p.samples, jitter));
        bool below = dot(direction, r.geometric_normal) < -1e-5;
        Occluder o = march(r, direction, fract(jitter.z + 0.61803399 * float(i)) + 1e-3);
        if (o.pixel.x < 0 && !below) {
            open += 1.0;
            continue;
        }
        blocked += sh_radiance(p.environment, direction);
        if (o.t >= 0.0 && !below) bounce += light_of(r, direction, o);
    }
    // Directions have density cos/pi: E = pi/N sum L.
    float weight = PI / float(p.samples);
    return vec4(less_blocked(bounce * weight, blocked * weight, r.normal), open / float(p.samples));
}
