// SPDX-License-Identifier: MIT
#include "gpu/gpu.h"

#include <gtest/gtest.h>

#include "gpu/recorder.h"

namespace luxel::gpu {
namespace {

TEST(Gpu, DispatchFillsABuffer) {
    Gpu gpu({.validation = true});
    const Buffer out = gpu.buffer(1000 * 4, "out");
    Recorder recorder(gpu);
    struct {
        std::uint32_t count = 1000;
        float unused[3] = {};
        float a = 2, b = 1;
    } params;
    recorder.dispatch("gpu/test/fill.comp", {1000}, params, {{"Values", out}});
    const auto times = recorder.submit();
    ASSERT_EQ(times.size(), 1u);
    const auto values = gpu.read_all<float>(out);
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], 2.0f * float(i) + 1.0f);
    EXPECT_EQ(gpu.validation_messages(), std::vector<std::string>());
}

} // namespace
} // namespace luxel::gpu
