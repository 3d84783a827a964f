// SPDX-License-Identifier: MIT
// Geometry for lists of fragments. MASKED: with what the alpha test needs.
#include "techniques/common/fragment_lists_params.h"
#include "techniques/frame/geometry.glsl"

layout(set = 0, binding = 2, scalar) readonly buffer normals { vec3 normal_of[]; };
layout(set = 0, binding = 3, scalar) uniform params { ListCaptureParams p; };
#ifdef MASKED
layout(set = 0, binding = 4, scalar) readonly buffer texcoords { vec2 texcoord_of[]; };
layout(set = 0, binding = 5, scalar) readonly buffer colors { vec4 color_of[]; };
layout(location = 5) out vec4 uv;
layout(location = 6) out float alpha;
#endif

layout(location = 0) out vec3 from_center;
layout(location = 1) out vec3 normal; // by the file, not normalized
layout(location = 2) out float depth;
layout(location = 3) flat out float handedness;
layout(location = 4) flat out uint instance_index;

void main() {
    InstanceRecord instance = instance_of[gl_InstanceIndex];
    vec3 world = world_vertex(instance);
    from_center = world - p.view.center;
    normal = instance.normal_to_world * normal_of[gl_VertexIndex];
    depth = (p.view.to_pixel * vec4(from_center, 1.0)).z;
    handedness = instance.handedness;
    instance_index = uint(gl_InstanceIndex);
#ifdef MASKED
    uv.xy = instance.uv0 == ABSENT ? vec2(0.0) : texcoord_of[gl_VertexIndex + instance.uv0];
    uv.zw = instance.uv1 == ABSENT ? vec2(0.0) : texcoord_of[gl_VertexIndex + instance.uv1];
    alpha = instance.color == ABSENT ? 1.0 : color_of[gl_VertexIndex + instance.color].a;
#endif
    gl_Position = p.world_to_clip * vec4(world, 1.0);
}
