// SPDX-License-Identifier: MIT
// The node of a fragment.
#include "shared/brdf.h"
#include "shared/octahedral.h"
#include "techniques/common/fragment_lists_params.h"

layout(set = 0, binding = 3, scalar) uniform params { ListCaptureParams p; };
layout(set = 0, binding = 10, scalar) readonly buffer materials { ListMaterial material_of[]; };

layout(location = 0) in vec3 from_center;
layout(location = 1) in vec3 normal;
layout(location = 2) in float depth;
layout(location = 3) flat in float handedness;
layout(location = 4) flat in uint instance_index;

struct ListFragment {
    uvec4 node; // without its neighbor
    uint shading;
    vec2 range; // of depth within the pixel: -least, greatest
};

ListFragment list_fragment() {
    // The normal of the front. On screen x points right and y down: of a front the cross product points away from the eye.
    vec3 plane = normalize(cross(dFdx(from_center), dFdy(from_center)));
    if (gl_FrontFacing == (handedness > 0.0)) plane = -plane;
    float length_n = length(normal);
    float ior = material_of[instance_index].ior;
    uint kind = ior == 0.0 || ior > THIN_IOR ? 0u : ior < 0.0 ? LIST_MIRROR : LIST_GLASS;

    // The offset goes with the rounded normal, so that the facet passes through the surface's point.
    ListFragment f;
    uint rounded = pack_unit(plane);
    f.node = uvec4(floatBitsToUint(dot(unpack_unit(rounded), from_center)), rounded, instance_index | kind, LIST_END);
    f.shading = pack_unit(length_n > 0.0 ? normal / length_n : plane);
    float slope = 0.5 * (abs(dFdx(depth)) + abs(dFdy(depth)));
    f.range = vec2(slope - depth, slope + depth);
    return f;
}
