// SPDX-License-Identifier: MIT
// The material of a batch (descriptor set 1) and its base color texture. Define TEXTURES first: what the
// material may have (CPU drivers execute untaken branches).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/frame/gpu_scene_params.h"
#include "techniques/frame/mask_params.h"
#define TEXTURES_NONE 0
#define TEXTURES_COMMON 1
#define TEXTURES_ALL 2

// An array of one, by an index that is always 0 but not known to the compiler: a branch on a uniform at a constant place
// makes lavapipe build a shader for its value at each draw and keep it forever, 40 MB a frame of Sponza. (It reads
// storage buffers as 0 where a quad's neighbors need derivatives.)
layout(set = 1, binding = 0, scalar) uniform material { MaterialRecord records[1]; };
#define m records[uint(gl_FragCoord.x) >> 24u]
#if TEXTURES != TEXTURES_NONE
layout(set = 1, binding = 1) uniform sampler2D base_color_texture;
#endif
#ifdef DISPLACED
layout(set = 1, binding = 8) uniform sampler2D height_texture;
vec4 uv_shift; // of both sets, from the polygon to the displaced surface
#endif

ivec2 wrap_texel(ivec2 texel, TextureRecord use) {
    ivec2 size = ivec2(use.size);
    ivec2 around = (texel + size) % size, inside = clamp(texel, ivec2(0), size - 1);
    return ivec2(use.wrap_u == WRAP_REPEAT ? around.x : inside.x,
                 use.wrap_v == WRAP_REPEAT ? around.y : inside.y);
}

// Mip 0 exactly as sample_texture in scene/surface.cpp reads it. uv: folded, or repeating within [0, 1).
vec4 exact_texel(sampler2D image, TextureRecord use, vec2 uv) {
    if (use.filter_mode == FILTER_NEAREST)
        return texelFetch(image, wrap_texel(ivec2(floor(uv * use.size)), use), 0);
    vec2 x = uv * use.size - 0.5;
    ivec2 corner = ivec2(floor(x));
    vec2 f = x - vec2(corner);
    vec4 top = mix(texelFetch(image, wrap_texel(corner, use), 0),
                   texelFetch(image, wrap_texel(corner + ivec2(1, 0), use), 0), f.x);
    vec4 bottom = mix(texelFetch(image, wrap_texel(corner + ivec2(0, 1), use), 0),
                      texelFetch(image, wrap_texel(corner + ivec2(1, 1), use), 0), f.x);
    return mix(top, bottom, f.y);
}

vec2 transformed(TextureRecord use, vec2 uv0, vec2 uv1) {
    vec3 uv = vec3(use.set == 0u ? uv0 : uv1, 1.0);
    return vec2(dot(use.u_row, uv), dot(use.v_row, uv));
}

// The mip level follows the coordinates before folding, which have no seams, and before displacement, which
// jumps at silhouettes. spread: 2 takes the next smaller mip.
vec4 look_up_at(sampler2D image, TextureRecord use, vec2 uv0, vec2 uv1, float spread) {
    vec2 t = transformed(use, uv0, uv1), at = t;
#ifdef DISPLACED
    vec2 shift = use.set == 0u ? uv_shift.xy : uv_shift.zw;
    at += vec2(dot(use.u_row.xy, shift), dot(use.v_row.xy, shift));
#endif
    vec2 wrapped = vec2(wrap_coordinate(at.x, use.size.x, use.wrap_u),
                        wrap_coordinate(at.y, use.size.y, use.wrap_v));
#if TEXTURES == TEXTURES_COMMON
    return textureGrad(image, wrapped, dFdx(t) * spread, dFdy(t) * spread);
#endif
    if (use.filter_mode == FILTER_SAMPLER)
        return textureGrad(image, wrapped, dFdx(t) * spread, dFdy(t) * spread);
    return exact_texel(image, use, fract(wrapped));
}
vec4 look_up(sampler2D image, TextureRecord use, vec2 uv0, vec2 uv1) {
    return look_up_at(image, use, uv0, uv1, 1.0);
}

#if TEXTURES != TEXTURES_NONE
// The base color, with an alpha for the alpha test. The mips of a mask hold coverage from level 1 on
// (frame/texture_levels.h): the share of pixels that stay, chosen by a low-discrepancy sequence over the
// pixels of about one depth, so that surfaces behind one another are cut independently. Between levels 0 and
// 1, which mean different things, a share of the pixels takes each. Alpha of vertices moves no outline: it
// hides or it does not.
vec4 look_up_base_color(vec2 uv0, vec2 uv1) {
    TextureRecord use = m.base_color_texture;
    float spread = 1.0;
    bool covers = false;
    MaskThresholds thresholds;
    if (m.alpha_cutoff > 0.0 && m.blended < 0.5 && use.filter_mode == FILTER_SAMPLER) {
        uint depth = floatBitsToUint(gl_FragCoord.z) >> 15;
        thresholds = mask_thresholds(uint(gl_FragCoord.x), uint(gl_FragCoord.y), depth);
        float level = textureQueryLod(base_color_texture, transformed(use, uv0, uv1)).y;
        covers = level > thresholds.level;
        spread = exp2((covers ? max(level, 1.0) : min(level, -0.5)) - level);
    }
    vec4 texel = look_up_at(base_color_texture, use, uv0, uv1, spread);
    if (covers) texel.a = texel.a > thresholds.coverage ? 1.0 : 0.0;
    return texel;
}
#endif
