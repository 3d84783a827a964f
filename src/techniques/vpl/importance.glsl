// SPDX-License-Identifier: MIT
// Importance of each candidate: the luminance that visible points reflect of it, together, as discs.
// SHADOWED: those that see it by their imperfect shadow maps [Ritschel2011].
#extension GL_EXT_scalar_block_layout : require
#include "techniques/vpl/importance_params.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) uniform params { VplImportanceParams p; };
layout(binding = 1) uniform samplerBuffer candidates;
layout(binding = 2, scalar) readonly buffer candidate_count { int count; };
layout(binding = 3) uniform samplerBuffer eyes;
layout(binding = 4, scalar) writeonly buffer importances { vec2 importance_of[]; }; // y: luminance of the flux
#ifdef SHADOWED
layout(binding = 5) uniform sampler2D shadow_maps;
#include "techniques/vpl/ism_visibility.glsl"
#endif

const vec3 LUMINANCE = vec3(0.2126, 0.7152, 0.0722);

void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= count) return;
    vec4 first = texelFetch(candidates, i * VPL_TEXELS);
    Vpl vpl = Vpl(first.xyz, first.w, texelFetch(candidates, i * VPL_TEXELS + 1).xyz,
                  texelFetch(candidates, i * VPL_TEXELS + 2).rgb);
    float sum = 0.0;
    for (int k = 0; k < p.points; ++k) {
        vec3 position = texelFetch(eyes, k * VPL_TEXELS).xyz, normal = texelFetch(eyes, k * VPL_TEXELS + 1).xyz;
        float kernel = vpl_disc_kernel(vpl, position, normal, normal);
#ifdef SHADOWED
        if (kernel > 0.0) kernel *= ism_visibility(shadow_maps, p.ism, k, position, normal, vpl.position, vpl.normal);
#endif
        sum += kernel * dot(LUMINANCE, vpl.flux * texelFetch(eyes, k * VPL_TEXELS + 2).rgb);
    }
    importance_of[i] = vec2(sum, dot(LUMINANCE, vpl.flux));
}
