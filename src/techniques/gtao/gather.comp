// SPDX-License-Identifier: MIT
// Openness alone.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/gtao/gather.glsl"
