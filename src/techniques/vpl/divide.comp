// SPDX-License-Identifier: MIT
// Cells that hold a discontinuity or touch one that does: light changes most beside edges, and what is
// interpolated there has neighbors on one side only.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D broken;
layout(binding = 1, r32f) uniform writeonly image2D divided; // 1: too coarse

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy), last = textureSize(broken, 0) - 1;
    if (any(greaterThan(cell, last))) return;
    float most = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            most = max(most, texelFetch(broken, clamp(cell + ivec2(x, y), ivec2(0), last), 0).r);
    imageStore(divided, cell, vec4(most));
}
