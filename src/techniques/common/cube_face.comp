// SPDX-License-Identifier: MIT
// A capture as a face of a distance cube, mirrored: see cube_face_view.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/cube.h"
#include "techniques/common/distance_cube_params.h"
#include "techniques/frame/compose_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { CubeFaceParams p; };
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D diffuse;
layout(binding = 3) uniform sampler2D specular;
layout(binding = 4) uniform sampler2D shading_normal;
layout(binding = 5) uniform sampler2D geometric_normal;
layout(binding = 6) uniform sampler2D direct;
layout(binding = 7) uniform sampler2D light;
layout(binding = 8) uniform sampler2D environment;
layout(binding = 9, rgba32f) uniform writeonly image2D radiance;
layout(binding = 10, rgba16f) uniform writeonly image2D normal;
layout(binding = 11, rgba16f) uniform writeonly image2D material;
layout(binding = 12, r32f) uniform writeonly image2D distance_from_center;
#include "techniques/frame/sky.glsl"

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= p.size || texel.y >= p.size) return;
    ivec2 pixel = ivec2(p.size - 1 - texel.x, texel.y);
    vec3 direction = cube_direction(p.face, (vec2(texel) + 0.5) / float(p.size));
    float z = texelFetch(depth, pixel, 0).r;

    // The pixel's ray has the component 1 along the view, so the point is z times it from the center.
    vec4 out_radiance =
             vec4(sky_radiance(environment, direction, p.environment_rotation, p.environment_scale), 0.0),
         out_normal = vec4(0.0), out_material = vec4(0.0);
    float out_distance = p.background;
    if (z > 0.0) {
        float side = texelFetch(geometric_normal, pixel, 0).a < 0.0 ? -1.0 : 1.0;
        out_radiance = vec4(texelFetch(light, pixel, 0).rgb, 1.0);
        out_normal = vec4(normalize(texelFetch(shading_normal, pixel, 0).xyz) * side, 1.0);
        out_material = cube_material(texelFetch(diffuse, pixel, 0).rgb, texelFetch(specular, pixel, 0).rgb,
                                     texelFetch(direct, pixel, 0).a);
        out_distance = z * length(direction);
    }
    imageStore(radiance, texel, out_radiance);
    imageStore(normal, texel, out_normal);
    imageStore(material, texel, out_material);
    imageStore(distance_from_center, texel, vec4(out_distance));
}
