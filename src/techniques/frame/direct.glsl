// SPDX-License-Identifier: MIT
// Adds a batch of lights, with their shadows, to the direct light of every pixel. SHADOW_MODE selects the
// filter at compile time: CPU drivers execute untaken branches.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/brdf.h"
#include "techniques/frame/direct_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { DirectParams p; };
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D diffuse;
layout(binding = 3) uniform sampler2D specular;
layout(binding = 4) uniform sampler2D normal;
layout(binding = 5) uniform sampler2D geometric_normal;
// Reversed depth, or for exponential maps the filtered linear depth.
layout(binding = 6) uniform sampler2DArray shadow_maps;
layout(binding = 7, rgba32f) uniform image2D direct;
layout(binding = 8, rgba32f) uniform image2D direct_diffuse;
#ifdef SHEETS // sheets.h
layout(binding = 9) uniform sampler2DArray optical_depths;
layout(binding = 10) uniform sampler2DArray nearest_sheets;

// Share of the light that passes the sheets in front of a receiver. All sheets of a map lie in front of what is
// solid there; a receiver on the nearest of them has none in front.
vec3 passed_sheets(vec2 texel, float z, uint map) {
    ivec2 nearest = clamp(ivec2(floor(texel)), ivec2(0), ivec2(p.map_size) - 1);
    if (z >= texelFetch(nearest_sheets, ivec3(nearest, map), 0).r) return vec3(1);
    return exp(-textureLod(optical_depths, vec3(texel / p.map_size, map), 0.0).rgb);
}
#else
float passed_sheets(vec2 texel, float z, uint map) { return 1.0; }
#endif

float stored(ivec2 texel, uint map) {
    return texelFetch(shadow_maps, ivec3(clamp(texel, ivec2(0), ivec2(p.map_size) - 1), map), 0).r;
}

// The 2x2 texels around a corner of texels, in the order of textureGather: (0, 1), (1, 1), (1, 0), (0, 0).
vec4 stored_around(vec2 corner, uint map) {
    return textureGather(shadow_maps, vec3(corner / p.map_size, map));
}
vec4 gather_weights(vec2 x, vec2 y) { return vec4(x[0] * y[1], x[1] * y[1], x[1] * y[0], x[0] * y[0]); }

// 3x3 box of bilinearly weighted compares: 4x4 texels, of which a gather reads four.
float percentage_closer(vec2 texel, float z, uint map) {
    vec2 corner = floor(texel - 0.5);
    vec4 wx = pcf_weights(texel.x - 0.5 - corner.x), wy = pcf_weights(texel.y - 0.5 - corner.y);
    vec4 a = vec4(lessThanEqual(stored_around(corner, map), vec4(z)));
    vec4 b = vec4(lessThanEqual(stored_around(corner + vec2(2, 0), map), vec4(z)));
    vec4 c = vec4(lessThanEqual(stored_around(corner + vec2(0, 2), map), vec4(z)));
    vec4 d = vec4(lessThanEqual(stored_around(corner + vec2(2, 2), map), vec4(z)));
    return dot(a, gather_weights(wx.xy, wy.xy)) + dot(b, gather_weights(wx.zw, wy.xy)) +
           dot(c, gather_weights(wx.xy, wy.zw)) + dot(d, gather_weights(wx.zw, wy.zw));
}

// Bilinear mean of four exponential compares [Rohleder2010, listing 8].
float exponential(vec2 texel, float r, float cos_theta, uint map) {
    vec2 corner = floor(texel - 0.5), f = texel - 0.5 - corner;
    vec4 occluder = stored_around(corner + 1.0, map), v;
    for (int i = 0; i < 4; ++i) v[i] = esm_visibility(r, occluder[i], p.esm_exponent, cos_theta);
    return dot(v, gather_weights(vec2(1.0 - f.x, f.x), vec2(1.0 - f.y, f.y)));
}

// Share of the light that reaches position, 0 to 1, by channel. n: geometric normal on the receiver's side.
vec3 visibility(ShadowedLight l, vec3 position, vec3 n, float cos_theta) {
    uint map = l.first_map;
    if (l.maps > 1u) {
        uint face = cube_face(l.axes, position - l.light.position);
        if (face >= l.maps) return vec3(1); // behind the plane of the light
        map += face;
    }
    ShadowView view = p.maps[map];
    float w = (view.world_to_map * vec4(position, 1.0)).w;
    vec3 receiver = position + n * receiver_offset(view, n, w, shadow_reach(SHADOW_MODE));
    vec4 clip = view.world_to_map * vec4(receiver, 1.0);
    vec3 c = clip.xyz / clip.w;
    vec2 texel = vec2(0.5 + 0.5 * c.x, 0.5 - 0.5 * c.y) * p.map_size;
    float z = c.z + DEPTH_ROUNDING;
    float lit;
    if (SHADOW_MODE == SHADOW_ESM)
        lit = exponential(texel, linear_light_depth(view, c.z), cos_theta, map);
    else if (SHADOW_MODE == SHADOW_PCF)
        lit = percentage_closer(texel, z, map);
    else
        lit = z >= stored(ivec2(floor(texel)), map) ? 1.0 : 0.0;
    return vec3(lit * passed_sheets(texel, z, map));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(p.view.width) || pixel.y >= int(p.view.height)) return;
    float z = texelFetch(depth, pixel, 0).r;
    if (z <= 0.0) return;

    vec3 position = world_position(p.view, vec2(pixel) + 0.5, z);
    vec3 n = normalize(texelFetch(normal, pixel, 0).xyz);
    vec3 ng = normalize(texelFetch(geometric_normal, pixel, 0).xyz);
    vec3 wo = p.view.parallel > 0.5 ? -p.view.forward : normalize(p.view.position - position);
    vec4 d = texelFetch(diffuse, pixel, 0), s = texelFetch(specular, pixel, 0);
    Brdf brdf = Brdf(d.rgb, s.rgb, vec3(s.a), max(d.a * d.a, MIN_ALPHA));
    bool mirror = d.a <= 0.0;            // no light sample meets an ideal lobe

    vec3 sum_diffuse = vec3(0), sum_specular = vec3(0);
    for (int i = 0; i < p.light_count; ++i) {
        ShadowedLight l = p.lights[i];
        LightSample light = sample_light(l.light, position);
        float cos_theta = dot(n, light.wi);
        if (cos_theta <= 0.0 || dot(ng, light.wi) <= 0.0 || light.irradiance == vec3(0)) continue;
        vec3 e = light.irradiance * visibility(l, position, ng, cos_theta);
        if (e == vec3(0)) continue;
        sum_diffuse += e * brdf.diffuse * (cos_theta / PI);
        if (mirror) continue;
        // A sample of a lamp or of the sky stands for directions around it.
        Brdf lobe = brdf;
        lobe.alpha = widened_alpha(brdf.alpha, sampled_solid_angle(l.light, light), dot(wo, normalize(wo + light.wi)));
        sum_specular += e * reflect_specular(lobe, n, ng, wo, light.wi);
    }
    imageStore(direct, pixel, imageLoad(direct, pixel) + vec4(sum_diffuse + sum_specular, 0));
    imageStore(direct_diffuse, pixel, imageLoad(direct_diffuse, pixel) + vec4(sum_diffuse, 0));
}
