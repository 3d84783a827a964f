// SPDX-License-Identifier: MIT
// Parts of blocks never overlap and come together again; many resources are few allocations.
#include "gpu/memory_blocks.h"

#include <iterator>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "gpu/context.h"
#include "gpu/format.h"
#include "gpu/recorder_data.h"

namespace luxel::gpu {
namespace {

TEST(FreeList, PartsDoNotOverlapAndComeTogetherAgain) {
    constexpr std::uint64_t bytes = 4096;
    FreeList list(bytes);
    std::map<std::uint64_t, std::uint64_t> taken; // offset: size
    std::mt19937 random(1);
    int refused = 0;
    for (int i = 0; i < 20000; ++i) {
        const std::uint64_t size = 1 + random() % 300, alignment = std::uint64_t(1) << random() % 8;
        if (random() % 2 == 0 || taken.empty()) {
            const auto offset = list.take(size, alignment);
            if (!offset) {
                ++refused;
                continue;
            }
            EXPECT_EQ(*offset % alignment, 0u);
            ASSERT_LE(*offset + size, bytes);
            const auto next = taken.lower_bound(*offset);
            if (next != taken.end()) {
                ASSERT_LE(*offset + size, next->first);
            }
            if (next != taken.begin()) {
                ASSERT_LE(std::prev(next)->first + std::prev(next)->second, *offset);
            }
            taken.emplace(*offset, size);
        } else {
            const auto part = std::next(taken.begin(), std::ptrdiff_t(random() % taken.size()));
            list.give_back(part->first);
            taken.erase(part);
        }
    }
    EXPECT_GT(refused, 0);
    for (const auto& [offset, size] : taken) list.give_back(offset);
    EXPECT_TRUE(list.unused());
    EXPECT_EQ(list.take(bytes, 1), 0u); // all in one piece
}

TEST(MemoryBlocks, ManyResourcesAreFewAllocations) {
    Gpu gpu({.validation = true});
    const Context& context = *gpu.data().context;
    const std::size_t before = context.allocations();
    std::vector<Image> images;
    std::vector<Buffer> buffers;
    for (int i = 0; i < 3000; ++i) {
        images.push_back(gpu.image({.width = 16, .height = 16}, "small"));
        buffers.push_back(gpu.buffer(1000, "small"));
    }
    EXPECT_LE(context.allocations(), before + 4);

    // Neighbors keep their own contents.
    const std::vector<float> a(250, 1.0f), b(250, 2.0f);
    const Buffer first = gpu.upload(std::span<const float>(a), "a"),
                 second = gpu.upload(std::span<const float>(b), "b");
    EXPECT_EQ(gpu.read_all<float>(first), a);
    EXPECT_EQ(gpu.read_all<float>(second), b);
    for (const std::string& message : gpu.validation_messages()) ADD_FAILURE() << message;
}

TEST(Formats, AMissingUseIsNamed) {
    const auto all = [](VkFormat) { return VkFormatFeatureFlags(0x7fffffff); };
    EXPECT_EQ(missing_format_use(all), "");
    const auto without_float_filter = [](VkFormat format) {
        const VkFormatFeatureFlags filter = VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
        return VkFormatFeatureFlags(0x7fffffff) & ~(format == VK_FORMAT_R32G32B32A32_SFLOAT ? filter : 0u);
    };
    EXPECT_EQ(missing_format_use(without_float_filter), "linear filtering of RGBA32F images");
}

} // namespace
} // namespace luxel::gpu
