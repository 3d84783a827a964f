// SPDX-License-Identifier: MIT
// Looks a texture up at the given places.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 64) in;
layout(scalar, binding = 0) uniform Params { float lod; } params;
layout(binding = 1) uniform sampler2D picture;
layout(scalar, binding = 2) readonly buffer Places { vec2 places[]; };
layout(scalar, binding = 3) writeonly buffer Found { vec4 found[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < places.length()) found[i] = textureLod(picture, places[i], params.lod);
}
