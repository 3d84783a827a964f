// SPDX-License-Identifier: MIT
// The scene's records as shaders read them: instances and materials.
#ifndef LUXEL_FRAME_GPU_SCENE_PARAMS_H
#define LUXEL_FRAME_GPU_SCENE_PARAMS_H
#include "shared/glsl.h"
LUXEL_BEGIN

LUXEL_CONST int ABSENT = -2147483647; // an attribute that the mesh does not have

// Attributes stand in one array each; an attribute's element is gl_VertexIndex plus the offset below.
struct InstanceRecord {
    mat4 object_to_world;
    mat3 normal_to_world; // inverse transpose up to a positive factor
    float handedness;     // -1 where the transform mirrors
    int uv0, uv1, tangent, color;
};

// One use of a texture by a material.
struct TextureRecord {
    vec3 u_row, v_row;   // uv' = (dot(u_row, (uv, 1)), dot(v_row, (uv, 1)))
    vec2 size;           // texels of mip 0
    uint wrap_u, wrap_v; // WRAP_*
    uint set;
    uint present;
    uint filter_mode; // FILTER_*
};
LUXEL_CONST uint FILTER_SAMPLER = 0u;  // as the sampler does it, with mips
LUXEL_CONST uint FILTER_BILINEAR = 1u; // in the shader, at 32 bits: samplers may round to 8
LUXEL_CONST uint FILTER_NEAREST = 2u;
LUXEL_CONST uint WRAP_REPEAT = 0u;
LUXEL_CONST uint WRAP_CLAMP = 1u;
LUXEL_CONST uint WRAP_MIRROR = 2u;

struct MaterialRecord {
    vec4 base_color;
    vec3 emission;
    float metallic;
    float roughness;
    float normal_scale;
    float ior;
    float specular;
    vec3 specular_color;
    float transmission;
    float alpha_cutoff; // 0: opaque
    float blended;      // 1: alpha is coverage, 0: alpha_cutoff decides
    uint double_sided;
    uint thin; // what passes is not refracted
    TextureRecord base_color_texture, metallic_roughness_texture, normal_texture, emission_texture,
        specular_texture, specular_color_texture, transmission_texture, height_texture;
    float height_scale;        // meters
    float multiple_scattering; // BrdfModel: 1 = multiple, 0 = single
    float clearcoat, clearcoat_roughness;
};

// What covers more of its pixel than this covers all of it, what covers less than 1 minus this covers
// nothing.
LUXEL_CONST float WHOLE_COVERAGE = 511.0f / 512.0f;

// The sampler repeats; the other modes are folded into [0, 1] here. Keeping half a texel away from the border
// makes the bilinear filter see the border texel twice, as clamping and mirroring do.
LUXEL_FN float wrap_coordinate(float x, float size, uint mode) {
    if (mode == WRAP_REPEAT) return x;
    if (mode == WRAP_MIRROR) {
        x = x - 2.0f * floor(x * 0.5f);
        if (x > 1.0f) x = 2.0f - x;
    }
    return clamp(x, 0.5f / size, 1.0f - 0.5f / size);
}

LUXEL_END
#endif
