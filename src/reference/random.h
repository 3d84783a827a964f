// SPDX-License-Identifier: MIT
// The random numbers of one sample of one pixel: the n-th is a pure function of (pixel, sample, seed, n).
#pragma once
#include "shared/random.h"

namespace luxel {

class Random {
public:
    Random(shared::uint pixel, shared::uint sample, shared::uint seed)
        : key_(shared::hash3(pixel, sample, seed)), dimension_(shared::hash3(sample, seed, pixel)) {}

    float next() { return shared::uniform_float(shared::hash2(key_, dimension_++)); } // [0, 1)
    glm::vec2 next2() {
        float x = next(); // in order: argument evaluation has none
        return {x, next()};
    }

private:
    shared::uint key_, dimension_;
};

} // namespace luxel
