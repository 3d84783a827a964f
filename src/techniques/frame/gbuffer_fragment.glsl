// SPDX-License-Identifier: MIT
// The surface under the pixel's center, as surface_at in scene/surface.cpp finds it. TEXTURES is
// TEXTURES_NONE, TEXTURES_COMMON (those of core glTF, filtered by the sampler) or TEXTURES_ALL. DISPLACED: it
// lies behind the polygon, by the material's height map.
// SHEET: what light passes straight through, seen from the light (sheets.h).
#include "shared/clearcoat.h"
#include "shared/thin_sheet.h"
#include "techniques/frame/material.glsl"
#include "techniques/frame/view_params.h"

#ifdef PEEL
layout(set = 0, binding = 7) uniform sampler2D farther_than; // linear depth of the view's pixels
#endif
#ifdef DISPLACED
#include "techniques/frame/displace.glsl"
#include "techniques/frame/displaced_params.h"
layout(set = 0, binding = 6, scalar) uniform params { DisplacedParams d; };
#define p d.peel
#define view p.view
layout(depth_less) out float gl_FragDepth; // reversed depth: displacement goes away from the eye
#elif defined(PEEL)
#include "techniques/frame/peel_params.h"
layout(set = 0, binding = 6, scalar) uniform params { PeelParams p; };
#define view p.view
#else
layout(set = 0, binding = 6, scalar) uniform params { ViewParams view; };
#endif

#if TEXTURES != TEXTURES_NONE
layout(set = 1, binding = 2) uniform sampler2D metallic_roughness_texture;
layout(set = 1, binding = 3) uniform sampler2D normal_texture;
layout(set = 1, binding = 4) uniform sampler2D emission_texture;
#endif
#if TEXTURES == TEXTURES_ALL
layout(set = 1, binding = 5) uniform sampler2D specular_texture;
layout(set = 1, binding = 6) uniform sampler2D specular_color_texture;
layout(set = 1, binding = 7) uniform sampler2D transmission_texture;
#endif

layout(location = 0) in vec3 from_eye;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec4 uv;
layout(location = 4) in vec4 color;
layout(location = 5) in float depth;
layout(location = 6) flat in float handedness;

#ifdef SHEET
layout(location = 0) out vec4 out_optical_depth;
layout(location = 1) out float out_nearest;
#else
layout(location = 0) out vec4 out_diffuse;
layout(location = 1) out vec4 out_specular;
layout(location = 2) out vec4 out_normal;
layout(location = 3) out vec4 out_geometric_normal;
layout(location = 4) out float out_depth;
layout(location = 5) out vec4 out_emission;
#endif

// World shading normal of the front side, normal map included. `geometric` stands in for degenerate input.
vec3 shading_normal(vec3 geometric) {
    float length_n = length(normal);
    if (!(length_n > 0.0)) return geometric;
    vec3 n = normal / length_n;
#if TEXTURES == TEXTURES_NONE
    return n;
#else
    float length_t = length(tangent.xyz);
    if (m.normal_texture.present == 0u || !(length_t > 0.0)) return n;

    // Tangent frame as glTF defines it.
    vec3 t = tangent.xyz / length_t;
    vec3 b = cross(n, t) * (tangent.w < 0.0 ? -1.0 : 1.0);
    vec3 texel = look_up(normal_texture, m.normal_texture, uv.xy, uv.zw).xyz * 2.0 - 1.0;
    vec3 bent = t * (texel.x * m.normal_scale) + b * (texel.y * m.normal_scale) + n * texel.z;
    float length_bent = length(bent);
    return length_bent > 0.0 ? bent / length_bent : n;
#endif
}

void main() {
    // The plane of the triangle, turned toward the camera; a mirroring transform exchanges front and back.
    vec3 along = view.parallel > 0.5 ? view.forward : from_eye; // the view ray
    vec3 geometric = cross(dFdx(from_eye), dFdy(from_eye));
    geometric = normalize(dot(geometric, along) > 0.0 ? -geometric : geometric);
    bool front = gl_FrontFacing == (handedness > 0.0);
    float side = front ? 1.0 : -1.0;
    float z = depth;
#ifdef DISPLACED
    Displaced relief = displace(from_eye, along, geometric, uv, d.search, front);
    float behind = relief.t * d.search.moves_depth;
    z += dot(relief.along, view.forward) * behind;
#endif

    // Factors times textures.
    vec4 base = m.base_color * color;
    float metallic = m.metallic, roughness = m.roughness;
    float specular = m.specular, transmission = m.transmission;
    vec3 specular_color = m.specular_color, emission = m.emission;
#if TEXTURES != TEXTURES_NONE
    if (m.base_color_texture.present != 0u)
        base *= look_up_base_color(uv.xy, uv.zw);
    if (m.metallic_roughness_texture.present != 0u) {
        vec4 t = look_up(metallic_roughness_texture, m.metallic_roughness_texture, uv.xy, uv.zw);
        roughness *= t.g;
        metallic *= t.b;
    }
    if (m.emission_texture.present != 0u)
        emission *= look_up(emission_texture, m.emission_texture, uv.xy, uv.zw).rgb;
#endif
#if TEXTURES == TEXTURES_ALL
    if (m.specular_texture.present != 0u)
        specular *= look_up(specular_texture, m.specular_texture, uv.xy, uv.zw).a;
    if (m.specular_color_texture.present != 0u)
        specular_color *= look_up(specular_color_texture, m.specular_color_texture, uv.xy, uv.zw).rgb;
    if (m.transmission_texture.present != 0u)
        transmission *= look_up(transmission_texture, m.transmission_texture, uv.xy, uv.zw).r;
#endif
    transmission *= 1.0 - metallic;

    // Normals, on the camera's side. A normal map says the relief's shading normals, too.
    vec3 shading = shading_normal(geometric * side) * side, to_eye = -normalize(along);
#ifdef DISPLACED
    if (m.normal_texture.present == 0u)
        shading = relief_normal(shading, relief.gradient, relief.axes, m.height_scale);
    if (relief.gradient != vec2(0.0))
        geometric = facing_normal(relief_normal(geometric, relief.gradient, relief.axes, m.height_scale),
                                  geometric, to_eye);
#endif
    vec3 n = bent_normal(shading, geometric, to_eye, share_without_diffuse(metallic, transmission));

    Brdf single = make_brdf(base.rgb, metallic, roughness, m.ior, specular, specular_color);
    Brdf multiple = make_brdf_toward(dot(n, to_eye), base.rgb, metallic, roughness, m.ior, specular, specular_color);
    Brdf lobes = mix_brdf(single, multiple, m.multiple_scattering);
    float lobe_roughness = roughness;
    if (m.clearcoat > 0.0) {
        float cos_o = dot(n, to_eye);
        Coat coat = make_coat(m.clearcoat, m.clearcoat_roughness, cos_o, m.multiple_scattering);
        lobes = coated_by_one_lobe(lobes, coat, m.clearcoat, metallic, cos_o);
        lobe_roughness = sqrt(lobes.alpha);
    }
    Brdf brdf = scale_brdf(lobes, 1.0 - transmission);

#ifdef SHEET
    // Sheets that add up multiply what passes. A ten-thousandth is as good as black. (Views of lights may mirror:
    // which side is the front is not known here.)
    if (roughness >= MIRROR_ROUGHNESS) transmission = 0.0; // it is spread
    vec3 passed = transmission * thin_transmittance(dot(shading, to_eye), m.ior, specular * specular_color, base.rgb);
    if (m.blended > 0.5) passed = mix(vec3(1.0), passed, clamp(base.a, 0.0, 1.0));
    out_optical_depth = vec4(-log(max(passed, vec3(1e-4))), 0.0);
    out_nearest = gl_FragCoord.z;
    if (m.blended < 0.5 && base.a < m.alpha_cutoff) discard;
#else
    out_diffuse = vec4(brdf.diffuse, is_mirror(metallic, roughness) ? 0.0 : max(lobe_roughness, MIRROR_ROUGHNESS));
    out_specular = vec4(brdf.f0, brdf.f90.x);
#ifdef PEEL
    float layer = min(p.blended, 1.0);
#else
    const float layer = 0.0;
#endif
    out_normal = vec4(n, mix(1.0, base.a, layer));
    out_geometric_normal = vec4(geometric, side);
    out_depth = z;
    out_emission = vec4(front || m.double_sided != 0u ? emission : vec3(0.0),
                        signed_ior(metallic, roughness, transmission, m.ior, m.thin != 0u));

#ifdef DISPLACED
    float reversed = view.parallel > 0.5 ? 1.0 - z / view.far : view.near / z;
    gl_FragDepth = behind > 0.0 ? min(reversed, gl_FragCoord.z) : gl_FragCoord.z;
#endif

    // Last, so that the derivatives above are those of whole quads.
    bool whole = base.a >= mix(m.alpha_cutoff, WHOLE_COVERAGE, m.blended);
    bool part = m.blended > 0.5 && !whole && base.a > 1.0 - WHOLE_COVERAGE;
    if (!(layer > 0.5 ? part : whole) || z > view.far) discard;
#ifdef PEEL
    float before = texelFetch(farther_than, ivec2(gl_FragCoord.xy), 0).r;
    if (z <= before || (p.blended > 1.5 && before <= 0.0)) discard;
    float solid = m.double_sided == 0u ? 1.0 : 0.0;
    if ((front ? p.drop_front : p.drop_back + p.drop_solid_back * solid) > 0.5) discard;
#endif
#endif
}
