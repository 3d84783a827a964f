// SPDX-License-Identifier: MIT
// A photon as the parallelogram around its disc: six vertices for each.
#include "shared/sampling.h"
#include "techniques/photon_map/photon_map_params.h"

layout(binding = 0, scalar) uniform params { PhotonSplatParams p; };
layout(binding = 1, scalar) readonly buffer photons { Photon photon_of[]; };
layout(binding = 2, scalar) readonly buffer counts { uint count_of[]; };
layout(location = 0) flat out vec3 middle; // from the camera, m
layout(location = 1) flat out vec4 normal; // a = half of the disc's length, m
layout(location = 2) flat out vec3 to_u;   // positions from the middle to the kernel's coordinates
layout(location = 3) flat out vec3 to_v;
layout(location = 4) flat out vec3 density; // W/m2 for a kernel of 1

// A whole multiple of the photons' distance, so that tents still add up to a constant, that is `least` or more.
float widened(float radius, float least) {
    if (radius < 1e-3 * least) return least;
    return min(radius * ceil(least / radius), max(p.most_radius, least));
}

// The axes x, y of a disc's parallelogram, in the plane, made no narrower than `pixel` says along its principal axes
// (M = U S V^T: only S changes).
mat2 widened_axes(mat2 m, mat2 pixel) {
    mat2 form = m * transpose(m);
    float angle = 0.5 * atan(2.0 * form[0][1], form[0][0] - form[1][1]);
    vec2 u1 = vec2(cos(angle), sin(angle)), u2 = vec2(-u1.y, u1.x);
    vec2 v1 = u1 * m, v2 = u2 * m;
    float s1 = length(v1), s2 = length(v2);
    v1 = s1 > 0.0 ? v1 / s1 : vec2(1, 0);
    vec2 across = vec2(-v1.y, v1.x);
    v2 = dot(v2, across) < 0.0 ? -across : across;
    s1 = widened(s1, length(u1 * pixel));
    s2 = widened(s2, length(u2 * pixel));
    return outerProduct(u1 * s1, v1) + outerProduct(u2 * s2, v2);
}

mat2 in_plane(vec3 x, vec3 y, mat3 frame) { return mat2((x * frame).xy, (y * frame).xy); }

void main() {
    int index = gl_VertexIndex / 6, corner = gl_VertexIndex % 6;
    gl_Position = vec4(2.0, 2.0, 0.5, 1.0);
    middle = to_u = to_v = density = vec3(0);
    normal = vec4(0);
    if (uint(index) >= count_of[PHOTON_COUNT]) return;
    Photon photon = photon_of[index];
    if (photon.state != PHOTON_ARRIVED) return;
    vec3 world = photon.position + p.center;
    middle = world - p.view.position;
    float depth = dot(middle, p.view.forward);
    if (depth < p.view.near) return;

    // So many times as large as what the photon's part of the beam lights: where nothing focuses it, that is
    // C0 / sqrt(cos / d^2) sqrt(A / N) [Le2014, 3.3.2.3] with C0 derived. Nothing is smaller than the frame's pixels on the
    // surface.
    vec3 n = photon.direction;
    mat3 frame = frame_around(n);
    float reach = photon.differential != 0u ? p.reach : p.reach_beam;
    vec3 toward = middle / min(dot(n, middle), -LEAST_COSINE * length(middle));
    vec3 right = p.view.right * (2.0 * depth * p.least / p.view.width), up = p.view.up * (2.0 * depth * p.least / p.view.height);
    mat2 pixel = in_plane(right - toward * dot(n, right), up - toward * dot(n, up), frame);
    mat2 axes = widened_axes(in_plane(photon.place_x * reach, photon.place_y * reach, frame), pixel);
    vec3 x = frame * vec3(axes[0], 0.0), y = frame * vec3(axes[1], 0.0);
    mat2 back = inverse(axes);
    to_u = frame * vec3(back[0][0], back[1][0], 0.0);
    to_v = frame * vec3(back[0][1], back[1][1], 0.0);
    density = photon.power / abs(determinant(axes));
    normal = vec4(n, max(length(x), length(y)));

    vec2 sides = corner == 0 ? vec2(-1, -1) : corner == 1 || corner == 3 ? vec2(1, -1)
               : corner == 2 || corner == 5 ? vec2(-1, 1) : vec2(1, 1);
    gl_Position = p.view.world_to_clip * vec4(world + x * sides.x + y * sides.y, 1.0);
    // Coarse pixels show a place beside their centers.
    gl_Position.xy += vec2(-2.0, 2.0) * p.shift / vec2(p.view.width, p.view.height) * gl_Position.w;
    // The frame's left upper part of the image; +1 is the upper border.
    gl_Position.x = (gl_Position.x + gl_Position.w) * p.share.x - gl_Position.w;
    gl_Position.y = gl_Position.w - (gl_Position.w - gl_Position.y) * p.share.y;
    gl_Position.z = 0.5 * gl_Position.w;
}
