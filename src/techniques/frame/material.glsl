// SPDX-License-Identifier: MIT
// The material of a batch (descriptor set 1) and its base color texture; the alpha test.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/frame/gpu_scene_params.h"

layout(set = 1, binding = 0, scalar) uniform material { MaterialRecord m; };
layout(set = 1, binding = 1) uniform sampler2D base_color_texture;

// The mip level follows the coordinates before folding, which have no seams.
vec4 look_up(sampler2D image, TextureRecord use, vec2 uv0, vec2 uv1) {
    vec3 uv = vec3(use.set == 0u ? uv0 : uv1, 1.0);
    vec2 t = vec2(dot(use.u_row, uv), dot(use.v_row, uv));
    vec2 wrapped = vec2(wrap_coordinate(t.x, use.size.x, use.wrap_u), wrap_coordinate(t.y, use.size.y, use.wrap_v));
    return textureGrad(image, wrapped, dFdx(t), dFdy(t));
}
