// SPDX-License-Identifier: MIT
// The first hit in each row.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/photon_map/lines.glsl"

layout(local_size_x = 64) in;
layout(binding = 6, scalar) writeonly buffer hits { PhotonHit hit_of[]; };
layout(binding = 7) uniform sampler2D met;

void main() {
    int row = int(gl_GlobalInvocationID.x);
    uint i = uint(p.first_row + row);
    if (row >= p.rows || !flies(i)) return;
    PhotonHit hit = PhotonHit(1e30, -1, 0u, 0u);
    ListRay r = photon_ray(i);
    if (r.first < r.last) {
        int pixels = line_of(r).pixels;
        for (int x = 0; x < pixels && hit.node < 0; ++x) {
            vec2 found = texelFetch(met, ivec2(x, row), 0).rg;
            hit = PhotonHit(found.x, int(found.y), uint(pixels), 0u);
        }
    }
    hit_of[i] = hit;
}
