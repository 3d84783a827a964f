// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define SHEET
#define TEXTURES TEXTURES_NONE
#include "techniques/frame/gbuffer_fragment.glsl"
