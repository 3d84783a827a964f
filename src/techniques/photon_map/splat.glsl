// SPDX-License-Identifier: MIT
// What a photon's disc adds to the pixels of its surface by KERNEL(u, v).
layout(binding = 0, scalar) uniform params { PhotonSplatParams p; };
layout(binding = 3) uniform sampler2D guide; // normal; a = linear depth
layout(location = 0) flat in vec3 middle;
layout(location = 1) flat in vec4 normal;
layout(location = 2) flat in vec3 to_u;
layout(location = 3) flat in vec3 to_v;
layout(location = 4) flat in vec3 density;
layout(location = 0) out vec4 sum; // W/m2

void main() {
    vec4 seen = texelFetch(guide, ivec2(gl_FragCoord.xy), 0);
    // The last pixel of the frame, where a block is cut; see guide.comp.
    vec2 last = vec2(p.view.width, p.view.height) * (1.0 - 0.5 / p.frame_size);
    vec3 from = world_position(p.view, min(gl_FragCoord.xy + p.shift, last), seen.a) - p.view.position - middle;
    // On the same surface: as the disc lies, on the side that the light came from.
    bool same = seen.a > 0.0 && dot(seen.xyz, normal.xyz) > 0.7 && abs(dot(from, normal.xyz)) < 0.3 * normal.a;
    float kernel = KERNEL(dot(from, to_u), dot(from, to_v));
    sum = vec4(same ? density * kernel : vec3(0), 0.0);
}
