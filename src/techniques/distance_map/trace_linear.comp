// SPDX-License-Identifier: MIT
#version 460
#define SEARCH LINEAR
#extension GL_GOOGLE_include_directive : require
#include "techniques/distance_map/trace.glsl"
