// SPDX-License-Identifier: MIT
// Openness and bent normals.
#version 460
#extension GL_GOOGLE_include_directive : require
#define BENT
#include "techniques/gtao/gather.glsl"
