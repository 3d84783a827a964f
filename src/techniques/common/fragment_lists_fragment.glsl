// SPDX-License-Identifier: MIT
// Appends a fragment to its pixel's list [Le2014, alg. 3.4].
#include "techniques/common/fragment_lists_node.glsl"

layout(set = 0, binding = 6, scalar) buffer heads { uint head_of[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer nodes { uvec4 node_of[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer shading { uint shading_of[]; };
layout(set = 0, binding = 9, scalar) buffer count { uint used; };
layout(location = 0) out vec2 range; // blended by max

void append(ListFragment f) {
    range = f.range;
    uint index = atomicAdd(used, 1u);
    if (index >= p.capacity) return; // counted: the pool grows, and the scene is drawn again
    uint pixel = uint(gl_FragCoord.y) * uint(p.view.side) + uint(gl_FragCoord.x);
    f.node[LIST_NEXT] = atomicExchange(head_of[pixel], index);
    node_of[index] = f.node;
    shading_of[index] = f.shading;
}
