// SPDX-License-Identifier: MIT
// A photon as the square around its disc: six vertices for each.
#include "shared/sampling.h"
#include "techniques/photon_map/photon_map_params.h"

layout(binding = 0, scalar) uniform params { PhotonSplatParams p; };
layout(binding = 1, scalar) readonly buffer photons { Photon photon_of[]; };
layout(binding = 2, scalar) readonly buffer counts { uint count_of[]; };
layout(location = 0) flat out vec4 disc;  // from the camera, m; radius
layout(location = 1) flat out vec3 normal;
layout(location = 2) flat out vec3 power;

void main() {
    int index = gl_VertexIndex / 6, corner = gl_VertexIndex % 6;
    gl_Position = vec4(2.0, 2.0, 0.5, 1.0);
    disc = vec4(0);
    normal = power = vec3(0);
    if (uint(index) >= count_of[PHOTON_COUNT]) return;
    Photon photon = photon_of[index];
    if (photon.state != PHOTON_ARRIVED) return;
    vec3 world = photon.position + p.center;
    disc.xyz = world - p.view.position;
    float depth = dot(disc.xyz, p.view.forward);
    if (depth < p.view.near) return;
    normal = photon.direction;
    power = photon.power;

    // The disc is so many times larger than what the photon's own part of the beam would light, had nothing focused it:
    // C0 / sqrt(cos / d^2) sqrt(A / N) [Le2014, 3.3.2.3] with C0 derived. Nothing is smaller than the frame's pixels
    // on the surface.
    float pixel = 2.0 * depth * max(length(p.view.right) / p.view.width, length(p.view.up) / p.view.height);
    float facing = max(abs(dot(normal, normalize(disc.xyz))), LEAST_COSINE);
    disc.w = max(sqrt(p.share * photon.beam / PI), p.least * pixel / facing);

    mat3 frame = frame_around(normal);
    vec2 sides = corner == 0 ? vec2(-1, -1) : corner == 1 || corner == 3 ? vec2(1, -1)
               : corner == 2 || corner == 5 ? vec2(-1, 1) : vec2(1, 1);
    gl_Position = p.view.world_to_clip * vec4(world + (frame[0] * sides.x + frame[1] * sides.y) * disc.w, 1.0);
    gl_Position.z = 0.5 * gl_Position.w;
}
