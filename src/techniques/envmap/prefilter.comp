// SPDX-License-Identifier: MIT
// One level of a probe's radiance prefiltered for glossy lobes: the mean over the GGX lobe of its roughness, seen along
// its normal [Karis2013], samples read from the level of the cube that is as wide as they are far apart [Krivanek2008].
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/brdf.h"
#include "shared/cube.h"
#include "shared/sampling.h"
#include "techniques/envmap/envmap_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { EnvmapPrefilterParams p; };
layout(binding = 1) uniform samplerCube radiance;
layout(binding = 2, rgba32f) uniform writeonly image2DArray prefiltered;

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID), size = imageSize(prefiltered);
    if (texel.x >= size.x || texel.y >= size.y) return;
    vec3 n = normalize(cube_direction(texel.z, (vec2(texel.xy) + 0.5) / float(size.x)));
    mat3 frame = frame_around(n);
    float alpha = max(p.roughness * p.roughness, MIN_ALPHA);
    float texels = 6.0 * float(p.size) * float(p.size) / (4.0 * PI); // of the cube, per steradian
    vec3 sum = vec3(0);
    float weight = 0.0;
    for (uint i = 0; i < ENVMAP_PREFILTER_SAMPLES; ++i) {
        vec3 h = frame * sample_visible_normal(vec3(0, 0, 1), alpha, hammersley(i, ENVMAP_PREFILTER_SAMPLES));
        vec3 l = reflect(-n, h);
        float cosine = dot(n, l);
        if (cosine <= 0.0) continue;
        float pdf = ggx_reflection_pdf(ggx_d(n, h, alpha), 1.0, alpha);
        float covered = texels / (float(ENVMAP_PREFILTER_SAMPLES) * pdf);
        sum += cosine * textureLod(radiance, l, max(0.5 * log2(covered) + 1.0, 0.0)).rgb;
        weight += cosine;
    }
    imageStore(prefiltered, texel, vec4(sum / weight, 1));
}
