// SPDX-License-Identifier: MIT
// Two triangles for each card.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/frame/impostor_params.h"
#include "techniques/frame/view_params.h"

layout(set = 0, binding = 0, scalar) readonly buffer cards { ImpostorCard card_of[]; };
layout(set = 0, binding = 1, scalar) uniform params { ViewParams view; };

layout(location = 0) out vec3 world;
layout(location = 1) out vec2 texel;
layout(location = 2) flat out int card_index;

void main() {
    ImpostorCard card = card_of[gl_InstanceIndex];
    vec2 at = vec2(gl_VertexIndex == 1 || gl_VertexIndex >= 4, gl_VertexIndex == 2 || gl_VertexIndex == 3 || gl_VertexIndex == 5);
    world = card.corner + card.edge_u * at.x + card.edge_v * at.y;
    texel = card.first + card.size * at;
    card_index = gl_InstanceIndex;
    gl_Position = view.world_to_clip * vec4(world, 1.0);
}
