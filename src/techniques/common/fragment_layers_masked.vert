// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define MASKED
#include "techniques/common/fragment_lists_vertex.glsl"
