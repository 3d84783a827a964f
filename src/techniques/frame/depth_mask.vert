// SPDX-License-Identifier: MIT
// Depth of alpha-masked geometry from a light.
#version 460
#include "techniques/frame/geometry.glsl"

layout(set = 0, binding = 2, scalar) readonly buffer texcoords { vec2 texcoord_of[]; };
layout(set = 0, binding = 3, scalar) readonly buffer colors { vec4 color_of[]; };
layout(set = 0, binding = 4, scalar) uniform params { mat4 world_to_clip; };

layout(location = 0) out vec4 uv;
layout(location = 1) out float alpha;

void main() {
    InstanceRecord instance = instance_of[gl_InstanceIndex];
    gl_Position = world_to_clip * vec4(world_vertex(instance), 1.0);
    uv.xy = instance.uv0 == ABSENT ? vec2(0.0) : texcoord_of[gl_VertexIndex + instance.uv0];
    uv.zw = instance.uv1 == ABSENT ? vec2(0.0) : texcoord_of[gl_VertexIndex + instance.uv1];
    alpha = instance.color == ABSENT ? 1.0 : color_of[gl_VertexIndex + instance.color].a;
}
