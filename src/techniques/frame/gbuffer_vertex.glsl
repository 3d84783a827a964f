// SPDX-License-Identifier: MIT
// Geometry as the camera sees it.
#include "techniques/frame/geometry.glsl"
#include "techniques/frame/view_params.h"

layout(set = 0, binding = 2, scalar) readonly buffer normals { vec3 normal_of[]; };
layout(set = 0, binding = 3, scalar) readonly buffer tangents { vec4 tangent_of[]; };
layout(set = 0, binding = 4, scalar) readonly buffer texcoords { vec2 texcoord_of[]; };
layout(set = 0, binding = 5, scalar) readonly buffer colors { vec4 color_of[]; };
#ifdef DISPLACED
#include "techniques/frame/displaced_params.h"
layout(set = 0, binding = 6, scalar) uniform params { DisplacedParams d; };
#define view d.peel.view
#elif defined(PEEL)
#include "techniques/frame/peel_params.h"
layout(set = 0, binding = 6, scalar) uniform params { PeelParams p; };
#define view p.view
#else
layout(set = 0, binding = 6, scalar) uniform params { ViewParams view; };
#endif

layout(location = 0) out vec3 from_eye; // world position minus the camera's
layout(location = 1) out vec3 normal;   // world, by the file, not normalized
layout(location = 2) out vec4 tangent;  // world, a = handedness; zero where there is none
layout(location = 3) out vec4 uv;
layout(location = 4) out vec4 color;
layout(location = 5) out float depth;
layout(location = 6) flat out float handedness;
invariant gl_Position; // frame/depth.vert has drawn the same depth

void main() {
    InstanceRecord instance = instance_of[gl_InstanceIndex];
    vec3 world = world_vertex(instance);
    from_eye = world - view.position;
    depth = dot(from_eye, view.forward);
    normal = instance.normal_to_world * normal_of[gl_VertexIndex];
    tangent = vec4(0.0);
    if (instance.tangent != ABSENT) {
        vec4 t = tangent_of[gl_VertexIndex + instance.tangent];
        tangent = vec4(mat3(instance.object_to_world) * t.xyz, t.w * instance.handedness);
    }
    uv.xy = instance.uv0 == ABSENT ? vec2(0.0) : texcoord_of[gl_VertexIndex + instance.uv0];
    uv.zw = instance.uv1 == ABSENT ? vec2(0.0) : texcoord_of[gl_VertexIndex + instance.uv1];
    color = instance.color == ABSENT ? vec4(1.0) : color_of[gl_VertexIndex + instance.color];
    handedness = instance.handedness;
    gl_Position = view.world_to_clip * vec4(world, 1.0);
}
