// SPDX-License-Identifier: MIT
// What a photon's disc adds to the pixels of its surface. KERNEL(r, h): energy per area at distance r.
layout(binding = 0, scalar) uniform params { PhotonSplatParams p; };
layout(binding = 3) uniform sampler2D guide; // normal; a = linear depth
layout(location = 0) flat in vec4 disc;
layout(location = 1) flat in vec3 normal;
layout(location = 2) flat in vec3 power;
layout(location = 0) out vec4 sum; // W/m2

void main() {
    vec4 seen = texelFetch(guide, ivec2(gl_FragCoord.xy), 0);
    vec3 from = world_position(p.view, gl_FragCoord.xy, seen.a) - p.view.position - disc.xyz;
    float r = length(from);
    // On the same surface: as the disc lies, on the side that the light came from.
    bool same = seen.a > 0.0 && r < disc.w && dot(seen.xyz, normal) > 0.7 && abs(dot(from, normal)) < 0.3 * disc.w;
    sum = vec4(same ? power * KERNEL(r, disc.w) : vec3(0), 0.0);
}
