// SPDX-License-Identifier: MIT
// The frame as an estimator of occlusion sees it. Everything is in camera space (see OcclusionParams).
#include "techniques/common/occlusion_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D normal;
// r = accessibility, g = 1 / depth, 0 where there is nothing: what the filter compares is linear on planes.
layout(binding = 3) uniform writeonly image2D accessibility;

struct Receiver {
    vec3 position;
    vec3 normal;
    bool there;  // false: background
    int pattern; // place in the 4x4 pattern
};

// v' = v + 2 w (u x v) + 2 u x (u x v) for the unit quaternion (u, w); the view direction becomes +z.
vec3 to_camera(OcclusionParams o, vec3 v) {
    vec3 t = 2.0 * cross(o.world_to_camera.xyz, v);
    vec3 turned = v + o.world_to_camera.w * t + cross(o.world_to_camera.xyz, t);
    return vec3(turned.xy, -turned.z);
}

vec3 occlusion_ray(OcclusionParams o, ivec2 pixel) { return vec3(vec2(pixel) * o.ray_scale + o.ray_offset, 1.0); }

Receiver occlusion_receiver(OcclusionParams o, ivec2 pixel) {
    Receiver x;
    float z = texelFetch(depth, pixel, 0).r;
    vec3 n = texelFetch(normal, pixel, 0).xyz;
    x.there = z > 0.0;
    x.position = occlusion_ray(o, pixel) * z;
    x.normal = to_camera(o, n);
    x.pattern = o.interleaved != 0u ? pattern_index(pixel) : 0;
    return x;
}

// Depth that hides what is behind it: nothing is hidden by the background.
float occluder_depth(ivec2 pixel) {
    float z = texelFetch(depth, pixel, 0).r;
    return z > 0.0 ? z : 1e30;
}

// Beyond the border the image is taken to go on as it ends: such taps move to the border.
ivec2 occlusion_pixel(OcclusionParams o, vec2 at) { return clamp(ivec2(floor(at)), ivec2(0), o.size - 1); }

void write_accessibility(Receiver x, ivec2 pixel, float open) {
    imageStore(accessibility, pixel, vec4(x.there ? open : 1.0, x.there ? 1.0 / x.position.z : 0.0, 0, 0));
}

// Homogeneous pixel coordinates of a point and of a difference: xy / z = pixel, centers at integers; z = depth.
vec3 to_pixel(OcclusionParams o, vec3 v) { return vec3((v.xy - o.ray_offset * v.z) / o.ray_scale, v.z); }
