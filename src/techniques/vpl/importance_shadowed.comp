// SPDX-License-Identifier: MIT
// With imperfect shadow maps at the visible points.
#version 460
#extension GL_GOOGLE_include_directive : require
#define SHADOWED
#include "techniques/vpl/importance.glsl"
