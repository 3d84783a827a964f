// SPDX-License-Identifier: MIT
// FLIP of a megapixel pair; HDR takes as much per exposure as LDR in all.
#include <cmath>

#include <benchmark/benchmark.h>

#include "core/flip.h"

namespace {

luxel::Image waves(float phase) {
    luxel::Image image(1024, 1024, 3);
    for (std::size_t i = 0; i < image.data.size(); ++i)
        image.data[i] = 0.5f + 0.5f * std::sin(phase + 0.01f * float(i % 9001));
    return image;
}

void flip_ldr(benchmark::State& state) {
    const luxel::Image reference = waves(0.0f), test = waves(1.0f);
    for (auto _ : state) benchmark::DoNotOptimize(luxel::flip_ldr(reference, test).mean);
}
BENCHMARK(flip_ldr)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace
