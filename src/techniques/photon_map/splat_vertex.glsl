// SPDX-License-Identifier: MIT
// A photon as the rectangle around its elliptic disc: six vertices for each.
#include "shared/sampling.h"
#include "techniques/photon_map/photon_map_params.h"

layout(binding = 0, scalar) uniform params { PhotonSplatParams p; };
layout(binding = 1, scalar) readonly buffer photons { Photon photon_of[]; };
layout(binding = 2, scalar) readonly buffer counts { uint count_of[]; };
layout(location = 0) flat out vec3 middle; // from the camera, m
layout(location = 1) flat out vec3 normal;
layout(location = 2) flat out vec4 long_axis; // unit; a = radius, m
layout(location = 3) flat out vec4 short_axis;
layout(location = 4) flat out vec3 power;

// Of the symmetric matrix M M^T of a disc's map M: the axes of the ellipse that it becomes.
struct Ellipse {
    vec2 direction; // of the long axis
    float long_radius, short_radius;
};
Ellipse ellipse_of(mat2 c) {
    float xx = c[0][0], yy = c[1][1], xy = c[0][1];
    float mean = 0.5 * (xx + yy), apart = length(vec2(0.5 * (xx - yy), xy));
    float angle = 0.5 * atan(2.0 * xy, xx - yy);
    return Ellipse(vec2(cos(angle), sin(angle)), sqrt(mean + apart), sqrt(max(mean - apart, 0.0)));
}

mat2 spread(vec3 x, vec3 y, mat3 frame) {
    vec2 a = (x * frame).xy, b = (y * frame).xy;
    return outerProduct(a, a) + outerProduct(b, b);
}

void main() {
    int index = gl_VertexIndex / 6, corner = gl_VertexIndex % 6;
    gl_Position = vec4(2.0, 2.0, 0.5, 1.0);
    middle = normal = power = vec3(0);
    long_axis = short_axis = vec4(0);
    if (uint(index) >= count_of[PHOTON_COUNT]) return;
    Photon photon = photon_of[index];
    if (photon.state != PHOTON_ARRIVED) return;
    vec3 world = photon.position + p.center;
    middle = world - p.view.position;
    float depth = dot(middle, p.view.forward);
    if (depth < p.view.near) return;
    normal = photon.direction;
    power = photon.power;

    // So many times as large as what the photon's part of the beam lights: where nothing focuses it, that is
    // C0 / sqrt(cos / d^2) sqrt(A / N) [Le2014, 3.3.2.3] with C0 derived. Widened by the frame's pixels on the surface, as
    // the sum of both quadratic forms does [Zwicker2001].
    mat3 frame = frame_around(normal);
    mat2 form = spread(photon.place_x * p.reach, photon.place_y * p.reach, frame);
    vec3 toward = middle / min(dot(normal, middle), -LEAST_COSINE * length(middle));
    vec3 right = p.view.right * (2.0 * depth * p.least / p.view.width), up = p.view.up * (2.0 * depth * p.least / p.view.height);
    form += spread(right - toward * dot(normal, right), up - toward * dot(normal, up), frame);
    Ellipse e = ellipse_of(form);
    long_axis = vec4(frame * vec3(e.direction, 0.0), min(e.long_radius, p.most_radius));
    short_axis = vec4(cross(normal, long_axis.xyz), min(e.short_radius, p.most_radius));

    vec2 sides = corner == 0 ? vec2(-1, -1) : corner == 1 || corner == 3 ? vec2(1, -1)
               : corner == 2 || corner == 5 ? vec2(-1, 1) : vec2(1, 1);
    vec3 to = long_axis.xyz * (sides.x * long_axis.w) + short_axis.xyz * (sides.y * short_axis.w);
    gl_Position = p.view.world_to_clip * vec4(world + to, 1.0);
    gl_Position.z = 0.5 * gl_Position.w;
}
