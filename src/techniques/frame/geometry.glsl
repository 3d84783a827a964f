// SPDX-License-Identifier: MIT
// Vertex pulling: positions of the scene's geometry.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/frame/gpu_scene_params.h"

layout(set = 0, binding = 0, scalar) readonly buffer positions { vec3 position_of[]; };
layout(set = 0, binding = 1, scalar) readonly buffer instances { InstanceRecord instance_of[]; };

// The same order of operations as transform_point in scene/surface.h.
vec3 world_vertex(InstanceRecord instance) {
    vec3 p = position_of[gl_VertexIndex];
    mat4 m = instance.object_to_world;
    return m[0].xyz * p.x + m[1].xyz * p.y + m[2].xyz * p.z + m[3].xyz;
}
