// SPDX-License-Identifier: MIT
// At the middle of each region of one level.
#include "techniques/vpl/gather.glsl"

layout(local_size_x = 64) in;
layout(binding = 7, scalar) readonly buffer regions { uint region[]; };
layout(binding = 8, scalar) readonly buffer region_counts { int region_count[]; };

void main() {
    uint i = gl_WorkGroupID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
    if (int(i) >= region_count[p.level]) return;
    ivec2 cell = ivec2(region[i] & 0xffffu, region[i] >> 16u);

    // The mean of the middle pixels, of which coarse regions have four.
    ivec2 first = cell << p.level;
    int taps = 1;
    if (p.level > 0) first += (1 << (p.level - 1)) - 1, taps = 2;
    ivec2 last = ivec2(p.view.width, p.view.height) - 1;
    Receiver r = Receiver(vec3(0), vec3(0), vec3(0));
    for (int k = 0; k < taps * taps; ++k) {
        ivec2 pixel = min(first + ivec2(k & 1, k >> 1), last);
        r.position += world_position(p.view, vec2(pixel) + 0.5, texelFetch(depth, pixel, 0).r);
        r.normal += texelFetch(normal, pixel, 0).xyz, r.plane += texelFetch(geometric_normal, pixel, 0).xyz;
    }
    r.position /= float(taps * taps), r.normal = normalize(r.normal), r.plane = normalize(r.plane);
    imageStore(irradiance, cell, vec4(gathered(r), 1));
}
