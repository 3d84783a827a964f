// SPDX-License-Identifier: MIT
// Photons at the ends of their rays: they arrive at diffuse surfaces and go on at specular ones.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/octahedral.h"
#include "techniques/photon_map/photon_map_params.h"
#include "techniques/photon_map/surface.glsl"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) uniform params { PhotonScatterParams p; };
layout(binding = 1, scalar) readonly buffer nodes { uvec4 node_of[]; };
layout(binding = 2, scalar) readonly buffer shading { uint shading_of[]; };
layout(binding = 3, scalar) readonly buffer materials { ListMaterial material_of[]; };
layout(binding = 4, scalar) buffer photons { Photon photon_of[]; };
layout(binding = 5, scalar) readonly buffer counts { uint count_of[]; };
layout(binding = 6, scalar) readonly buffer hits { PhotonHit hit_of[]; };

// Glass by chance, so that one photon stays one.
Scattered scatter(vec3 d, vec3 n, ListMaterial m, bool inside, vec3 u) {
    if (m.ior < 0.0) return reflect_photon(d, n, m.f0, m.f90, m.roughness, u.xy);
    if (u.x < glass_reflectance(d, n, m.ior, inside)) return mirrored_by_glass(d, n, inside);
    return refracted_by_glass(d, n, m.ior, inside);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= min(count_of[PHOTON_COUNT], uint(p.most))) return;
    Photon photon = photon_of[i];
    if (photon.state != PHOTON_FLYING) return;
    PhotonHit hit = hit_of[i];
    if (hit.node < 0) {
        photon_of[i].state = PHOTON_LOST;
        return;
    }
    photon.position += photon.direction * hit.t;
    photon.travelled += hit.t;
    uvec4 node = node_of[hit.node];
    ListMaterial m = material_of[node[LIST_WHAT] & LIST_INSTANCE];
    if (m.ior == 0.0) {
        vec3 n = unpack_unit(node[LIST_NORMAL]);
        float cosine = dot(n, photon.direction);
        photon.direction = cosine < 0.0 ? n : -n;
        photon.state = PHOTON_ARRIVED;
        float across = photon.parallel != 0u ? 1.0 : photon.travelled * photon.travelled;
        photon.beam *= across / max(abs(cosine), LEAST_COSINE);
    } else if (p.last != 0u) {
        photon.state = PHOTON_LOST;
    } else {
        vec3 n = unpack_unit(shading_of[hit.node]);
        Scattered to = scatter(photon.direction, n, m, photon.inside != 0u, random3(i, p.bounce, p.seed));
        photon.direction = to.direction;
        photon.power *= to.weight;
        photon.inside = to.inside ? 1u : 0u;
        if (max(to.weight.r, max(to.weight.g, to.weight.b)) <= 0.0) photon.state = PHOTON_LOST;
    }
    photon_of[i] = photon;
}
