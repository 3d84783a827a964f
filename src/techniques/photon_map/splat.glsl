// SPDX-License-Identifier: MIT
// What a photon's disc adds to the pixels of its surface. KERNEL(q, r1, r2): energy per area at a share q of the radii.
layout(binding = 0, scalar) uniform params { PhotonSplatParams p; };
layout(binding = 3) uniform sampler2D guide; // normal; a = linear depth
layout(location = 0) flat in vec3 middle;
layout(location = 1) flat in vec3 normal;
layout(location = 2) flat in vec4 long_axis;
layout(location = 3) flat in vec4 short_axis;
layout(location = 4) flat in vec3 power;
layout(location = 0) out vec4 sum; // W/m2

void main() {
    vec4 seen = texelFetch(guide, ivec2(gl_FragCoord.xy), 0);
    vec3 from = world_position(p.view, gl_FragCoord.xy + p.shift, seen.a) - p.view.position - middle;
    float q = length(vec2(dot(from, long_axis.xyz) / long_axis.w, dot(from, short_axis.xyz) / short_axis.w));
    // On the same surface: as the disc lies, on the side that the light came from.
    bool same = seen.a > 0.0 && q < 1.0 && dot(seen.xyz, normal) > 0.7 && abs(dot(from, normal)) < 0.3 * long_axis.w;
    sum = vec4(same ? power * KERNEL(q, long_axis.w, short_axis.w) : vec3(0), 0.0);
}
