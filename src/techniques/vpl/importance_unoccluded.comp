// SPDX-License-Identifier: MIT
// Whatever lies between.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/vpl/importance.glsl"
