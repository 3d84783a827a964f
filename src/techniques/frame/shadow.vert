// SPDX-License-Identifier: MIT
// Depth of opaque geometry from a light.
#version 460
#include "techniques/frame/geometry.glsl"

layout(set = 0, binding = 2, scalar) uniform params { mat4 world_to_map; };

void main() { gl_Position = world_to_map * vec4(world_vertex(instance_of[gl_InstanceIndex]), 1.0); }
