// SPDX-License-Identifier: MIT
// One thread for each photon walks over the pixels of the lists.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/fragment_lists_march.glsl"
#include "techniques/photon_map/photon_map_params.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) uniform params { PhotonTraceParams p; };
layout(binding = 4, scalar) readonly buffer photons { Photon photon_of[]; };
layout(binding = 5, scalar) readonly buffer counts { uint count_of[]; };
layout(binding = 6, scalar) writeonly buffer hits { PhotonHit hit_of[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= min(count_of[PHOTON_COUNT], uint(p.most))) return;
    Photon photon = photon_of[i];
    if (photon.state != PHOTON_FLYING) return;
    float w = (p.view.to_pixel * vec4(photon.position, 1.0)).w;
    float start = p.start * p.view.pixel * max(w, 0.0);
    ListHit hit = march_lists(p.view, list_ray(p.view, photon.position, photon.direction, photon.inside != 0u, start));
    hit_of[i] = PhotonHit(hit.t, hit.node, hit.cells, hit.nodes);
}
