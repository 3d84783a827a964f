// SPDX-License-Identifier: MIT
// One thread for each photon walks over the pixels of the lists.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/fragment_lists_march.glsl"
#include "techniques/photon_map/rays.glsl"

layout(local_size_x = 64) in;
layout(binding = 6, scalar) writeonly buffer hits { PhotonHit hit_of[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (!flies(i)) return;
    ListHit hit = march_lists(p.view, photon_ray(i));
    hit_of[i] = PhotonHit(hit.t, hit.node, hit.cells, hit.nodes);
}
