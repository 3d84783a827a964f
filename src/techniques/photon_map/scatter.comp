// SPDX-License-Identifier: MIT
// Photons at the ends of their rays: they arrive at diffuse surfaces and go on at specular ones.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/fragment_lists.glsl"
#include "techniques/photon_map/photon_map_params.h"
#include "techniques/photon_map/surface.glsl"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) uniform params { PhotonScatterParams p; };
layout(binding = 3, scalar) readonly buffer shading { uint shading_of[]; };
layout(binding = 4, scalar) readonly buffer materials { ListMaterial material_of[]; };
layout(binding = 5, scalar) buffer photons { Photon photon_of[]; };
layout(binding = 6, scalar) readonly buffer counts { uint count_of[]; };
layout(binding = 7, scalar) readonly buffer hits { PhotonHit hit_of[]; };
#include "techniques/photon_map/curvature.glsl"

// Which way a photon goes on: by chance at glass, so that one photon stays one.
bool refracts(vec3 d, vec3 n, ListMaterial m, bool inside, float u) {
    return m.ior > 0.0 && u >= glass_reflectance(d, n, m.ior, inside);
}
Scattered scatter(vec3 d, vec3 n, ListMaterial m, bool inside, bool through, vec2 u) {
    if (m.ior < 0.0) return reflect_photon(d, n, m.f0, m.f90, m.roughness, u);
    return through ? refracted_by_glass(d, n, m.ior, inside) : mirrored_by_glass(d, n, inside);
}

// What the photon's part of the beam lights of the surface that it arrives at: as its neighbors' rays say [Igehy1999], or a
// circle, had nothing focused the beam.
void span_part(inout Photon photon, vec3 d, float t, float cosine) {
    vec3 n = photon.direction;
    if (photon.differential != 0u) {
        vec3 along = d / min(dot(n, d), -LEAST_COSINE);
        vec3 x = photon.place_x + photon.turn_x * t, y = photon.place_y + photon.turn_y * t;
        photon.place_x = x - along * dot(n, x);
        photon.place_y = y - along * dot(n, y);
        return;
    }
    float across = photon.parallel != 0u ? 1.0 : photon.travelled * photon.travelled;
    mat3 frame = frame_around(n) * sqrt(photon.beam * across / max(cosine, LEAST_COSINE));
    photon.place_x = frame[0];
    photon.place_y = frame[1];
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
        vec3 d = photon.direction;
        float cosine = dot(n, d);
        photon.direction = cosine < 0.0 ? n : -n;
        photon.state = PHOTON_ARRIVED;
        span_part(photon, d, hit.t, abs(cosine));
    } else if (p.last != 0u) {
        photon.state = PHOTON_LOST;
    } else {
        vec3 n = normal_at(photon.position, node, unpack_unit(shading_of[hit.node])), d = photon.direction;
        vec3 u = random3(photon.key, p.bounce, p.seed);
        bool inside = photon.inside != 0u, through = refracts(d, n, m, inside, u.z);
        Scattered to = scatter(d, n, m, inside, through, u.xy);

        // The neighbors' rays go the same way, from where they meet the surface and with its normals there.
        if (photon.differential != 0u) {
            vec3 plane = unpack_unit(node[LIST_NORMAL]), along = d / dot(plane, d);
            vec3 x = photon.place_x + photon.turn_x * hit.t, y = photon.place_y + photon.turn_y * hit.t;
            photon.place_x = x - along * dot(plane, x);
            photon.place_y = y - along * dot(plane, y);
            Change cx = normal_change(photon.position, photon.place_x, node), cy = normal_change(photon.position, photon.place_y, node);
            vec3 to_x = scatter(normalize(d + photon.turn_x), normalize(n + cx.n), m, inside, through, u.xy).direction;
            vec3 to_y = scatter(normalize(d + photon.turn_y), normalize(n + cy.n), m, inside, through, u.xy).direction;
            // A neighbor may be reflected totally where this one passes, which leaves it no direction.
            bool both = dot(to_x, to_x) > 0.0 && dot(to_y, to_y) > 0.0;
            bool lobe = m.ior < 0.0 && m.roughness > 0.0;
            if (!both || !cx.there || !cy.there || lobe) photon.differential = 0u;
            photon.turn_x = to_x - to.direction;
            photon.turn_y = to_y - to.direction;
        }
        photon.direction = to.direction;
        photon.power *= to.weight;
        photon.inside = to.inside ? 1u : 0u;
        if (max(to.weight.r, max(to.weight.g, to.weight.b)) <= 0.0) photon.state = PHOTON_LOST;
    }
    photon_of[i] = photon;
}
