// SPDX-License-Identifier: MIT
#version 460
layout(location = 0) in vec3 value; // W/m2
layout(location = 0) out vec4 sum;
void main() { sum = vec4(value, 0.0); }
