// SPDX-License-Identifier: MIT
// The frame's own pixels: they send and receive.
#version 460
#extension GL_GOOGLE_include_directive : require
#define RECEIVERS
#include "techniques/isr/downsample.glsl"
