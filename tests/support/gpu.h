// SPDX-License-Identifier: MIT
// A GPU for tests, with the Khronos layer watching: a test in this fixture fails on any message.
#pragma once
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gpu/context.h"
#include "gpu/gpu.h"

namespace luxel::testing {

// One Gpu for all tests of a suite. Without the layer its tests are skipped, unless LUXEL_REQUIRE_VALIDATION
// is 1.
class GpuTest : public ::testing::Test {
protected:
    static void SetUpTestSuite() {
        if (gpu::validation_available())
            gpu_ = std::make_unique<gpu::Gpu>(gpu::GpuOptions{.validation = true});
    }
    static void TearDownTestSuite() { gpu_.reset(); }

    void SetUp() override {
        const char* required = std::getenv("LUXEL_REQUIRE_VALIDATION");
        if (gpu_)
            messages_before_ = gpu_->validation_messages().size();
        else if (required && std::string(required) == "1")
            FAIL() << "VK_LAYER_KHRONOS_validation is not installed";
        else
            GTEST_SKIP() << "VK_LAYER_KHRONOS_validation is not installed";
    }
    void TearDown() override {
        if (!gpu_) return;
        const std::vector<std::string> messages = gpu_->validation_messages();
        for (std::size_t i = messages_before_; i < messages.size(); ++i) ADD_FAILURE() << messages[i];
    }
    gpu::Gpu& gpu() { return *gpu_; }

private:
    static inline std::unique_ptr<gpu::Gpu> gpu_;
    std::size_t messages_before_ = 0;
};

} // namespace luxel::testing
