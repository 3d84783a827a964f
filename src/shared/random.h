// SPDX-License-Identifier: MIT
// Counter-based random numbers: a value is a pure function of its keys, so images do not depend on scheduling.
#ifndef LUXEL_SHARED_RANDOM_H
#define LUXEL_SHARED_RANDOM_H
#include "shared/glsl.h"
LUXEL_BEGIN

// PCG hash of one 32-bit word [Jarzynski2020].
LUXEL_FN uint pcg(uint v) {
    uint state = v * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

LUXEL_FN uint hash2(uint a, uint b) { return pcg(a ^ pcg(b)); }
LUXEL_FN uint hash3(uint a, uint b, uint c) { return pcg(a ^ pcg(b ^ pcg(c))); }

// Top 24 bits to [0, 1).
LUXEL_FN float uniform_float(uint bits) { return float(bits >> 8u) * (1.0f / 16777216.0f); }

LUXEL_END
#endif
