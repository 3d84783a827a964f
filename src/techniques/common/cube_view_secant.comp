// SPDX-License-Identifier: MIT
#version 460
#define SEARCH SECANT
#extension GL_GOOGLE_include_directive : require
#include "techniques/common/cube_view.glsl"
