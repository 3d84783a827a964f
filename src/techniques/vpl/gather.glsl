// SPDX-License-Identifier: MIT
// Irradiance from all virtual point lights. KERNEL: KERNEL_DISC, KERNEL_BOUNDED or KERNEL_THESIS, at compile
// time: CPU drivers execute untaken branches. SHADOWED: with imperfect shadow maps.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/vpl/vpl_params.h"

#define KERNEL_DISC 0
#define KERNEL_BOUNDED 1
#define KERNEL_THESIS 2

layout(binding = 0, scalar) uniform params { VplGatherParams p; };
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D normal;
layout(binding = 3) uniform sampler2D geometric_normal;
layout(binding = 4) uniform samplerBuffer lights;
layout(binding = 5, scalar) readonly buffer light_count { int count; };
layout(binding = 6, rgba32f) uniform writeonly image2D irradiance; // a = 1 where there is a surface

#ifdef SHADOWED
layout(binding = 9) uniform sampler2D shadow_maps;
#include "techniques/vpl/ism_visibility.glsl"
#endif

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
#if KERNEL == KERNEL_THESIS
        float kernel = vpl_thesis_kernel(vpl, r.position, r.normal);
#elif KERNEL == KERNEL_BOUNDED
        float kernel = vpl_bounded_kernel(vpl, r.position, r.normal, r.plane, p) / PI;
#else
        float kernel = vpl_disc_kernel(vpl, r.position, r.normal, r.plane) / PI;
#endif
#ifdef SHADOWED
        if (kernel > 0.0) kernel *= ism_visibility(shadow_maps, p.ism, i, vpl.position, vpl.normal, r.position, r.plane);
#endif
        sum += vpl.flux * kernel;
    }
    return sum;
}
