// SPDX-License-Identifier: MIT
// A cone whose sum over the texels is the photon's power [Le2014, 3.3.2.3].
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/caustics_params.h"

layout(location = 0) in vec2 offset;
layout(location = 1) flat in vec3 irradiance;
layout(location = 2) flat in float radius;
layout(location = 0) out vec4 sum;

void main() {
    float kernel = 3.0 / (PI * radius * radius) * max(1.0 - length(offset), 0.0);
    sum = vec4(irradiance * kernel, 0.0);
}
