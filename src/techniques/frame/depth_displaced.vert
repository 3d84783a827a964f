// SPDX-License-Identifier: MIT
// Geometry with a relief as a light sees it.
#version 460
#include "techniques/frame/geometry.glsl"
#include "techniques/frame/displaced_params.h"

layout(set = 0, binding = 2, scalar) readonly buffer texcoords { vec2 texcoord_of[]; };
layout(set = 0, binding = 3, scalar) readonly buffer colors { vec4 color_of[]; };
layout(set = 0, binding = 4, scalar) uniform params { DisplacedDepthParams p; };

layout(location = 0) out vec4 uv;
layout(location = 1) out float alpha;
layout(location = 2) out vec3 world;
layout(location = 3) out flat float handedness;

void main() {
    InstanceRecord instance = instance_of[gl_InstanceIndex];
    world = world_vertex(instance);
    gl_Position = p.world_to_clip * vec4(world, 1.0);
    uv.xy = instance.uv0 == ABSENT ? vec2(0.0) : texcoord_of[gl_VertexIndex + instance.uv0];
    uv.zw = instance.uv1 == ABSENT ? vec2(0.0) : texcoord_of[gl_VertexIndex + instance.uv1];
    alpha = instance.color == ABSENT ? 1.0 : color_of[gl_VertexIndex + instance.color].a;
    handedness = instance.handedness;
}
