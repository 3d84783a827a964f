// SPDX-License-Identifier: MIT
// Appends the fragment to its pixel's list [Le2014, alg. 3.4].
#include "shared/brdf.h"
#include "shared/octahedral.h"
#include "techniques/common/fragment_lists_params.h"

layout(set = 0, binding = 3, scalar) uniform params { ListCaptureParams p; };
layout(set = 0, binding = 6, scalar) buffer heads { uint head_of[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer nodes { uvec4 node_of[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer shading { uint shading_of[]; };
layout(set = 0, binding = 9, scalar) buffer count { uint node_count; };
layout(set = 0, binding = 10, scalar) readonly buffer materials { ListMaterial material_of[]; };

layout(location = 0) in vec3 from_center;
layout(location = 1) in vec3 normal;
layout(location = 2) in float depth;
layout(location = 3) flat in float handedness;
layout(location = 4) flat in uint instance_index;
layout(location = 0) out vec2 range; // blended by max

void append_fragment() {
    // The normal of the front; the offset goes with the rounded one, so that the facet passes through the surface's point.
    vec3 plane = normalize(cross(dFdx(from_center), dFdy(from_center)));
    float winding = (gl_FrontFacing == (handedness > 0.0)) ? 1.0 : -1.0;
    // On screen x points right and y down: of a front the cross product points away from the eye.
    plane *= -winding;
    float length_n = length(normal);
    vec3 smooth_normal = length_n > 0.0 ? normal / length_n : plane;
    uint packed_plane = pack_unit(plane);

    // The pixel's share of the facet is as deep as this.
    float slope = 0.5 * (abs(dFdx(depth)) + abs(dFdy(depth)));
    range = vec2(slope - depth, slope + depth);

    uint index = atomicAdd(node_count, 1u);
    if (index >= p.capacity) return; // counted: the pool grows, and the scene is drawn again
    float ior = material_of[instance_index].ior;
    uint kind = ior == 0.0 || ior > THIN_IOR ? 0u : ior < 0.0 ? LIST_MIRROR : LIST_GLASS;
    uint pixel = uint(gl_FragCoord.y) * uint(p.view.side) + uint(gl_FragCoord.x);
    uint next = atomicExchange(head_of[pixel], index);
    node_of[index] = uvec4(floatBitsToUint(dot(unpack_unit(packed_plane), from_center)), packed_plane,
                           instance_index | kind, next);
    shading_of[index] = pack_unit(smooth_normal);
}
