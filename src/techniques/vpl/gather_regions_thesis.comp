// SPDX-License-Identifier: MIT
// As printed in the thesis.
#version 460
#extension GL_GOOGLE_include_directive : require
#define KERNEL KERNEL_THESIS
#include "techniques/vpl/gather_regions.glsl"
