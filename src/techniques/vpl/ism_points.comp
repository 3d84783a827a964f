// SPDX-License-Identifier: MIT
// Points where their instances stand in this frame: (position, radius), (normal, 0).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/frame/gpu_scene_params.h"
#include "techniques/vpl/ism_params.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer instances { InstanceRecord instance_of[]; };
layout(binding = 1, scalar) readonly buffer points { IsmPoint point[]; };
layout(binding = 2, scalar) writeonly buffer placed { vec4 texel_of[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= point.length()) return;
    IsmPoint q = point[i];
    InstanceRecord instance = instance_of[q.instance];
    texel_of[2 * i] = vec4((instance.object_to_world * vec4(q.position, 1)).xyz, q.radius);
    bool is_point = q.normal != vec3(0);
    texel_of[2 * i + 1] = vec4(is_point ? normalize(instance.normal_to_world * q.normal) : vec3(0), 0);
}
