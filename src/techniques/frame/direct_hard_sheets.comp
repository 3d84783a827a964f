// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define SHEETS
#define SHADOW_MODE SHADOW_HARD
#include "techniques/frame/direct.glsl"
