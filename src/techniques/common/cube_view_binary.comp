// SPDX-License-Identifier: MIT
#version 460
#define SEARCH BINARY
#extension GL_GOOGLE_include_directive : require
#include "techniques/common/cube_view.glsl"
