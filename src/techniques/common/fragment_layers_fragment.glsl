// SPDX-License-Identifier: MIT
// The nearest fragment behind the last layer.
#include "techniques/common/fragment_lists_node.glsl"

layout(set = 0, binding = 6) uniform sampler2D farther_than;
layout(location = 0) out uvec4 node;
layout(location = 1) out uint shading;
layout(location = 2) out vec2 range;
layout(location = 3) out float layer_depth; // linear

void peel(ListFragment f) {
    if (depth <= texelFetch(farther_than, ivec2(gl_FragCoord.xy), 0).r) discard;
    node = f.node;
    shading = f.shading;
    range = f.range;
    layer_depth = depth;
}
