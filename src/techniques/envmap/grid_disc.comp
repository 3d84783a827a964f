// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GRID
#define POINT_FACTOR disc_factor
#include "techniques/envmap/gather.glsl"
