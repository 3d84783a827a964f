// SPDX-License-Identifier: MIT
// Opaque surfaces.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/fragment_lists_fragment.glsl"

void main() { append(list_fragment()); }
