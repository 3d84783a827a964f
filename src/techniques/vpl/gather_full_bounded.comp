// SPDX-License-Identifier: MIT
// Lights as points, bounded.
#version 460
#extension GL_GOOGLE_include_directive : require
#define KERNEL KERNEL_BOUNDED
#include "techniques/vpl/gather_full.glsl"
