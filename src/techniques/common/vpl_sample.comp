// SPDX-License-Identifier: MIT
// Candidates for virtual point lights: pixels of a reflective shadow map, each for its share of the image.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/random.h"
#include "techniques/common/rsm_params.h"
#include "techniques/common/vpl_params.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) uniform params { VplSampleParams p; };
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D normal;
layout(binding = 3) uniform sampler2D geometric_normal;
layout(binding = 4) uniform sampler2D reflected;
layout(binding = 5, scalar) writeonly buffer candidates { vec4 texel_of[]; };

void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= p.count) return;
    bool disc = p.disc != 0u;
    vec2 random = vec2(uniform_float(hash2(uint(i), 0u)), uniform_float(hash2(uint(i), 1u)));
    vec2 uv = vpl_image_point(vpl_unit_point(i, p.count, p.pattern, p.shift, random), disc);
    ivec2 pixel = min(ivec2(uv * p.view.width), ivec2(p.view.width) - 1);
    vec2 center = vec2(pixel) + 0.5;
    float z = texelFetch(depth, pixel, 0).r;

    Vpl vpl = Vpl(vec3(0), 0.0, vec3(0), vec3(0));
    if (z > 0.0) {
        vpl.position = world_position(p.view, center, z);
        vpl.normal = normalize(texelFetch(geometric_normal, pixel, 0).xyz);
        vec3 wi = sample_light(p.light, vpl.position).wi;
        float c = dot(vpl.normal, wi), lit = dot(normalize(texelFetch(normal, pixel, 0).xyz), wi);
        float pixels = pixels_per_vpl(p.view.width, p.count, disc);
        float bounded = max(c, VPL_GRAZING);
        vpl.bound = pixels * pixel_beam_area(p.view, center, vpl.position) / (bounded * PI);

        // The flux is that which meets the triangle; the lobe stands on the shading normal.
        if (c > 0.0) vpl.flux = texelFetch(reflected, pixel, 0).rgb * (pixels * max(lit, 0.0) / bounded);
    }
    int at = (p.first + i) * VPL_TEXELS;
    texel_of[at] = vec4(vpl.position, vpl.bound);
    texel_of[at + 1] = vec4(vpl.normal, 0);
    texel_of[at + 2] = vec4(vpl.flux, 0);
}
