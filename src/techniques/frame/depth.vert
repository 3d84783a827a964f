// SPDX-License-Identifier: MIT
// Depth of opaque geometry, from a light or before the G-buffer.
#version 460
#include "techniques/frame/geometry.glsl"

layout(set = 0, binding = 2, scalar) uniform params { mat4 world_to_clip; };

invariant gl_Position; // the G-buffer pass meets the same depth

void main() { gl_Position = world_to_clip * vec4(world_vertex(instance_of[gl_InstanceIndex]), 1.0); }
