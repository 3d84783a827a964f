// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GRID
#define QUAD_FACTOR quad_factor_thesis
#include "techniques/envmap/gather.glsl"
