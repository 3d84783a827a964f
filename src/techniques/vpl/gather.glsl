// SPDX-License-Identifier: MIT
// Irradiance from all virtual point lights. THESIS: by the thesis's kernel; SHADOWED: with imperfect shadow maps.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/vpl/vpl_params.h"

layout(binding = 0, scalar) uniform params { VplGatherParams p; };
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D normal;
layout(binding = 3) uniform sampler2D geometric_normal;
layout(binding = 4) uniform samplerBuffer lights;
layout(binding = 5, scalar) readonly buffer light_count { int count; };
layout(binding = 6, rgba32f) uniform writeonly image2D irradiance; // a = 1 where there is a surface

struct Receiver {
    vec3 position, normal, plane;
};

Vpl vpl_at(int i) {
    int at = i * VPL_TEXELS;
    vec4 first = texelFetch(lights, at);
    return Vpl(first.xyz, first.w, texelFetch(lights, at + 1).xyz, texelFetch(lights, at + 2).rgb);
}

vec3 gathered(Receiver r) {
    vec3 sum = vec3(0);
    for (int i = 0; i < count; ++i) {
        Vpl vpl = vpl_at(i);
#ifdef THESIS
        sum += vpl.flux * vpl_thesis_kernel(vpl, r.position, r.normal);
#else
        sum += vpl.flux * (vpl_kernel(vpl, r.position, r.normal, r.plane, p) / PI);
#endif
    }
    return sum;
}
