// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/photon_map/photon_map_params.h"
#define KERNEL(u, v) photon_cone(u, v)
#include "techniques/photon_map/splat.glsl"
