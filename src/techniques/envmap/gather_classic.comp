// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define CLASSIC
#include "techniques/envmap/gather.glsl"
