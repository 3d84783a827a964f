// SPDX-License-Identifier: MIT
// Photons as rays in the lists.
#include "techniques/common/fragment_lists.glsl"
#include "techniques/photon_map/photon_map_params.h"

layout(binding = 0, scalar) uniform params { PhotonTraceParams p; };
layout(binding = 4, scalar) readonly buffer photons { Photon photon_of[]; };
layout(binding = 5, scalar) readonly buffer counts { uint count_of[]; };

bool flies(uint i) {
    return i < min(count_of[PHOTON_COUNT], uint(p.most)) && photon_of[i].state == PHOTON_FLYING;
}

ListRay photon_ray(uint i) {
    Photon photon = photon_of[i];
    float w = (p.view.to_pixel * vec4(photon.position, 1.0)).w;
    return list_ray(p.view, photon.position, photon.direction, photon.inside != 0u, p.start * p.view.pixel * max(w, 0.0));
}
