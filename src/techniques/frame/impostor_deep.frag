// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define DEEP
#include "techniques/frame/impostor_fragment.glsl"
