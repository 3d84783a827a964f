// SPDX-License-Identifier: MIT
// What the GGX lobe reflects of light of radiance 1 all around is f0 A + f90 B; A and B by the cosine of the view, along
// x, and roughness, along y, each from 0 in the first to 1 in the last texel [Karis2013].
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/brdf.h"
#include "shared/sampling.h"
#include "techniques/envmap/envmap_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rg32f) uniform writeonly image2D reflectance;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(reflectance);
    if (any(greaterThanEqual(texel, size))) return;
    vec2 at = vec2(texel) / vec2(size - 1);
    float cos_o = max(at.x, 1e-3), alpha = max(at.y * at.y, MIN_ALPHA);
    vec3 wo = vec3(sqrt(1.0 - cos_o * cos_o), 0, cos_o);
    vec2 sum = vec2(0);
    for (uint i = 0; i < ENVMAP_PREFILTER_SAMPLES; ++i) {
        vec3 h = sample_visible_normal(wo, alpha, hammersley(i, ENVMAP_PREFILTER_SAMPLES));
        vec3 wi = reflect(-wo, h);
        if (wi.z <= 0.0) continue;
        // The distribution of normals is in both and cancels.
        float share = ggx_v(wi.z, cos_o, alpha) * wi.z / ggx_reflection_pdf(1.0, cos_o, alpha);
        float fresnel = fresnel_schlick(vec3(0), vec3(1), dot(wo, h)).x;
        sum += share * vec2(1.0 - fresnel, fresnel);
    }
    imageStore(reflectance, texel, vec4(sum / float(ENVMAP_PREFILTER_SAMPLES), 0, 0));
}
