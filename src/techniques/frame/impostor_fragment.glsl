// SPDX-License-Identifier: MIT
// The sample of an impostor under the pixel. Its linear depth is that of the sampled surface, which is where
// light meets it. What hides what is decided on the card; with DEEP, at the sampled surface [Schaufler1997].
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/brdf.h"
#include "techniques/frame/impostor_params.h"
#include "techniques/frame/view_params.h"

layout(set = 0, binding = 0, scalar) readonly buffer cards { ImpostorCard card_of[]; };
layout(set = 0, binding = 1, scalar) uniform params { ViewParams view; };
layout(set = 1, binding = 0) uniform sampler2D diffuse;
layout(set = 1, binding = 1) uniform sampler2D specular;
layout(set = 1, binding = 2) uniform sampler2D normal;
layout(set = 1, binding = 3) uniform sampler2D geometric_normal;
layout(set = 1, binding = 4) uniform sampler2D depth;
layout(set = 1, binding = 5) uniform sampler2D emission;

layout(location = 0) in vec3 world;
layout(location = 1) in vec2 texel;
layout(location = 2) flat in int card_index;

layout(location = 0) out vec4 out_diffuse;
layout(location = 1) out vec4 out_specular;
layout(location = 2) out vec4 out_normal;
layout(location = 3) out vec4 out_geometric_normal;
layout(location = 4) out float out_depth;
layout(location = 5) out vec4 out_emission;

// Nearest and farthest sample at a texel and beside it.
vec2 depths_about(ivec2 at, ImpostorCard card, float seen) {
    ivec2 first = ivec2(card.first), last = ivec2(card.first + card.size) - 1;
    vec2 range = vec2(seen);
    for (int i = 0; i < 4; ++i) {
        ivec2 beside = ivec2(i == 0 ? 1 : i == 1 ? -1 : 0, i == 2 ? 1 : i == 3 ? -1 : 0);
        float z = texelFetch(depth, clamp(at + beside, first, last), 0).r;
        if (z > 0.0) range = vec2(min(range.x, z), max(range.y, z));
    }
    return range;
}

void main() {
    // The nearest texel: a mean of two would be a surface that is nowhere.
    ImpostorCard card = card_of[card_index];
    ivec2 at = ivec2(clamp(texel, card.first, card.first + card.size - 1.0));
    float seen = texelFetch(depth, at, 0).r;
    vec4 ng = texelFetch(geometric_normal, at, 0);
    ng.xyz = card.turn * ng.xyz;

    // Where the pixel's ray meets the sample's tangent plane, but not beyond the samples beside it, or for a cloud
    // beyond the distance that it allows: a point beside the surface would lie in the object's own shadow.
    vec2 center = (vec2(at) + 0.5 - card.first) / card.size;
    vec3 sampled = card_sample(card, card.corner + card.edge_u * center.x + card.edge_v * center.y, seen);
    vec3 ray = world - view.position;
    ray /= dot(ray, view.forward);
    float sample_z = dot(sampled - view.position, view.forward), facing = dot(ray, ng.xyz);
    float z = abs(facing) > 1e-4 ? dot(sampled - view.position, ng.xyz) / facing : sample_z;
    vec2 range = card.parallel > 0.5 ? vec2(-card.depth, card.depth) : depths_about(at, card, seen) - seen;
    z = clamp(z, sample_z + range.x, sample_z + range.y);

    // From behind the card its samples show their other side.
    float side = dot(world - view.position, card.forward) < 0.0 ? -1.0 : 1.0;
    ng *= side;
    vec3 n = card.turn * texelFetch(normal, at, 0).xyz * side;
    vec3 to_eye = -normalize(ray);
    if (dot(n, to_eye) < LEAST_FACING_COSINE) n = facing_normal(n, ng.xyz, to_eye);

    out_diffuse = texelFetch(diffuse, at, 0);
    out_specular = texelFetch(specular, at, 0);
    out_normal = vec4(n, 1.0);
    out_geometric_normal = ng;
    out_depth = z;
    out_emission = texelFetch(emission, at, 0);
#ifdef DEEP
    gl_FragDepth = view.near / max(z, view.near);
#endif
    if (seen <= 0.0 || z < view.near || z > view.far) discard;
}
