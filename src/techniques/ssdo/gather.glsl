// SPDX-License-Identifier: MIT
// What both estimators read and write.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/ssdo/ssdo_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { SsdoParams p; };
layout(binding = 1) uniform sampler2D surface;  // geometric normal, depth (0 = nothing)
layout(binding = 2) uniform sampler2D receiver; // shading normal, depth
layout(binding = 3) uniform sampler2D source;   // radiance that the surface sends
// rgb: irradiance that the occluders send less the environment's that they block; a: accessibility.
layout(binding = 4, rgba32f) uniform writeonly image2D irradiance;

struct Receiver {
    vec3 position, normal, geometric_normal;
};

vec3 position_at(ivec2 pixel, float z) {
    return world_position(p.view, full_pixel(vec2(pixel), p.scale) + 0.5, z);
}

bool is_inside(ivec2 pixel) {
    return pixel.x >= 0 && pixel.y >= 0 && pixel.x < int(p.width) && pixel.y < int(p.height);
}

// The gathered pixel of a homogeneous position.
ivec2 pixel_of(vec3 h) { return ivec2(floor(h.xy / (h.z * float(p.scale)))); }

// No surface at or below the receiver's tangent plane can block its hemisphere. 1/100 covers the rounding of
// normals, which are half floats; a hundred thousandth of the depth that of positions.
bool is_above(Receiver r, vec3 to_surface, float depth) {
    return dot(r.geometric_normal, to_surface) > 0.01 * length(to_surface) + 1e-5 * depth;
}

// The environment cannot lose more than what arrives.
vec3 less_blocked(vec3 bounce, vec3 blocked, vec3 n) {
    return bounce - min(blocked, sh_irradiance(p.environment, n));
}

vec4 gather(Receiver r, ivec2 pixel);

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(p.width) || pixel.y >= int(p.height)) return;
    vec4 at = texelFetch(receiver, pixel, 0);
    vec4 e = vec4(0, 0, 0, 1);
    if (at.w > 0.0) {
        Receiver r;
        r.position = position_at(pixel, at.w);
        r.normal = normalize(at.xyz);
        r.geometric_normal = texelFetch(surface, pixel, 0).xyz;
        e = gather(r, pixel);
    }
    imageStore(irradiance, pixel, e);
}
