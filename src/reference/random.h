// SPDX-License-Identifier: MIT
// The random numbers of one sample of one pixel: the n-th is a pure function of (pixel, sample, seed, n).
// Over the samples of a pixel the n-th pair is a (0, 2)-sequence with its own Owen scrambling and order
// [Burley2020], so that a pixel's samples cover each integral evenly. Samples that are equal modulo
// sample_groups share a sequence; the sequences are independent, so their means tell the noise.
#pragma once
#include "shared/random.h"

namespace luxel {

inline constexpr int sample_groups = 4;
// How many of `spp` samples are in a group.
constexpr int group_samples(int spp, int group) { return (spp + sample_groups - 1 - group) / sample_groups; }

class Random {
public:
    Random(shared::uint pixel, shared::uint sample, shared::uint seed)
        : key_(shared::hash3(pixel, sample % shared::uint(sample_groups), seed)),
          reversed_index_(reversed(sample / shared::uint(sample_groups))) {}

    // [0, 1)
    float next() {
        const shared::uint key = shared::hash2(key_, dimension_++);
        return shared::uniform_float(scrambled(ordered(key), shared::pcg(key + 1u)));
    }
    glm::vec2 next2() {
        const shared::uint key = shared::hash2(key_, dimension_++), i = ordered(key);
        return {shared::uniform_float(scrambled(i, shared::pcg(key + 1u))),
                shared::uniform_float(scrambled(reversed_sobol(i), shared::pcg(key + 2u)))};
    }

private:
    static shared::uint reversed(shared::uint v) {
        v = (v << 16u) | (v >> 16u);
        v = ((v & 0x00ff00ffu) << 8u) | ((v & 0xff00ff00u) >> 8u);
        v = ((v & 0x0f0f0f0fu) << 4u) | ((v & 0xf0f0f0f0u) >> 4u);
        v = ((v & 0x33333333u) << 2u) | ((v & 0xccccccccu) >> 2u);
        return ((v & 0x55555555u) << 1u) | ((v & 0xaaaaaaaau) >> 1u);
    }
    // Second dimension of the Sobol sequence, its bits in reverse. (The first is the index itself, reversed
    // twice.)
    static shared::uint reversed_sobol(shared::uint i) {
        shared::uint value = 0;
        for (shared::uint direction = 1; i != 0; i >>= 1u, direction ^= direction << 1u)
            if ((i & 1u) != 0) value ^= direction;
        return value;
    }
    // Flips each bit as a hash of the bits below it says [Laine2011], the constants as in [Burley2020].
    static shared::uint permuted(shared::uint v, shared::uint seed) {
        v ^= v * 0x3d20adeau;
        v += seed;
        v *= (seed >> 16u) | 1u;
        v ^= v * 0x05526c56u;
        return v ^ (v * 0x53a22864u);
    }
    // Owen scrambling of a number whose bits come in reverse: each by those that are above it in the result.
    static shared::uint scrambled(shared::uint bits, shared::uint seed) {
        return reversed(permuted(bits, seed));
    }
    // The sample's place in the sequence, shuffled so that pairs do not follow each other.
    shared::uint ordered(shared::uint key) const { return scrambled(reversed_index_, key); }

    shared::uint key_, reversed_index_, dimension_ = 0;
};

} // namespace luxel
