// SPDX-License-Identifier: MIT
// Lights as discs of their area, with imperfect shadow maps.
#version 460
#extension GL_GOOGLE_include_directive : require
#define KERNEL KERNEL_DISC
#define SHADOWED
#include "techniques/vpl/gather_regions.glsl"
