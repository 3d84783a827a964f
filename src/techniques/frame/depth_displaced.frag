// SPDX-License-Identifier: MIT
// Depth of the relief behind a polygon, from a light.
#version 460
#extension GL_GOOGLE_include_directive : require
#define DISPLACED
#define TEXTURES TEXTURES_ALL
#include "techniques/frame/material.glsl"
#include "techniques/frame/displace.glsl"
#include "techniques/frame/displaced_params.h"

layout(set = 0, binding = 4, scalar) uniform params { DisplacedDepthParams p; };

layout(location = 0) in vec4 uv;
layout(location = 1) in float alpha;
layout(location = 2) in vec3 world;
layout(location = 3) in flat float handedness;

layout(depth_less) out float gl_FragDepth; // reversed depth: displacement goes away from the light

void main() {
    vec3 from_eye = p.eye.w > 0.0 ? world - p.eye.xyz / p.eye.w : -p.eye.xyz;
    vec3 plane = normalize(cross(dFdx(world), dFdy(world)));
    if (dot(plane, from_eye) > 0.0) plane = -plane;
    Displaced relief =
        displace(world, from_eye, plane, uv, p.search, gl_FrontFacing == (handedness * p.handedness > 0.0));

    vec4 clip = p.world_to_clip * vec4(world + relief.along * relief.t, 1.0);
    gl_FragDepth = relief.t > 0.0 ? min(clip.z / clip.w, gl_FragCoord.z) : gl_FragCoord.z;
    float texel = look_up_base_color(uv.xy, uv.zw).a;
    if (m.base_color.a * texel * alpha < m.alpha_cutoff) discard;
}
