// SPDX-License-Identifier: MIT
// Lights as discs of their area.
#version 460
#extension GL_GOOGLE_include_directive : require
#define KERNEL KERNEL_DISC
#include "techniques/vpl/gather_full.glsl"
