// SPDX-License-Identifier: MIT
// The kernel of vpl_params.h.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/vpl/gather_full.glsl"
