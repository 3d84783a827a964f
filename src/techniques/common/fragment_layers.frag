// SPDX-License-Identifier: MIT
// Opaque surfaces.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/fragment_layers_fragment.glsl"

void main() { peel(list_fragment()); }
