// SPDX-License-Identifier: MIT
// Pixels that the frame does not show: they only send.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/isr/downsample.glsl"
