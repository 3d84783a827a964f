// SPDX-License-Identifier: MIT
// Its color comes from the batch; half of the screen belongs to each.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(scalar, set = 0, binding = 0) uniform Params { float split; } params;
layout(set = 1, binding = 0) uniform sampler2D picture;
layout(scalar, set = 1, binding = 1) readonly buffer Side { uint side; };
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
void main() {
    if ((uv.x < params.split) != (side == 0u)) discard;
    color = textureLod(picture, uv, 0.0);
}
