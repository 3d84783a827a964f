// SPDX-License-Identifier: MIT
// Devices, memory, uploads and readback.
#include "gpu/gpu.h"

#include "core/error.h"
#include "gpu/check.h"
#include "gpu/program.h"
#include "gpu/recorder.h"
#include "support/gpu.h"

namespace luxel::gpu {
namespace {

class GpuResources : public testing::GpuTest {};

std::string error_of(const GpuOptions& options, Fault fault) {
    try {
        Gpu gpu(options);
    } catch (const Error& e) {
        EXPECT_EQ(e.fault(), fault);
        return e.what();
    }
    return "";
}

TEST(Devices, AreListedAndChosenByIndexOrName) {
    const std::vector<DeviceInfo> devices = list_devices();
    for (const DeviceInfo& d : devices) {
        EXPECT_FALSE(d.name.empty() || d.driver.empty() || d.api_version.empty());
        EXPECT_GT(d.memory_bytes, 0u);
        if (!d.unsuitable.empty()) continue;
        EXPECT_EQ(Gpu({.device = std::to_string(d.index)}).device().index, d.index);
        EXPECT_EQ(Gpu({.device = d.name}).device().name, d.name);
        EXPECT_EQ(Gpu({.device = d.name.substr(1, 4)}).device().name, d.name);
    }
}

TEST(Devices, AnUnknownNameIsASentenceThatListsTheKnown) {
    if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device on this machine";
    const std::string text = error_of({.device = "Voodoo 2"}, Fault::usage);
    EXPECT_NE(text.find("Voodoo 2"), std::string::npos) << text;
    EXPECT_NE(text.find(list_devices()[0].name), std::string::npos) << text;
    EXPECT_NE(error_of({.device = "99"}, Fault::usage), "");
}

// Runs in a process of its own, whose loader finds no driver.
TEST(DevicesDeathTest, NoDriverIsAnEmptyListAndASentence) {
    ::testing::FLAGS_gtest_death_test_style = "threadsafe";
    EXPECT_EXIT(
        {
            ::setenv("VK_ICD_FILENAMES", "/nowhere.json", 1);
            ::setenv("VK_DRIVER_FILES", "/nowhere.json", 1);
            const bool empty = list_devices().empty();
            const std::string text = error_of({}, Fault::unsupported);
            std::fprintf(stderr, "%s\n", text.c_str());
            std::_Exit(empty && !text.empty() ? 0 : 1);
        },
        ::testing::ExitedWithCode(0), "gpu: no Vulkan (driver|device) was found");
}

TEST_F(GpuResources, BuffersComeBackAsTheyWent) {
    const std::vector<std::uint32_t> values = {1, 2, 3, 5, 8, 13, 21};
    const Buffer buffer = gpu().upload<std::uint32_t>(values, "values");
    EXPECT_EQ(buffer.size(), 28u);
    EXPECT_EQ(buffer.name(), "values");
    EXPECT_EQ(gpu().read_all<std::uint32_t>(buffer), values);
    std::uint32_t fifth = 0;
    gpu().read(buffer, std::as_writable_bytes(std::span(&fifth, 1)), 16);
    EXPECT_EQ(fifth, 8u);

    const Buffer nothing = gpu().upload<float>({}, "nothing");
    EXPECT_EQ(nothing.size(), 0u);
    EXPECT_TRUE(gpu().read_all<float>(nothing).empty());
}

TEST_F(GpuResources, FloatImagesComeBackAsTheyWent) {
    for (const int channels : {1, 3, 4}) {
        luxel::Image image(5, 3, channels);
        for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = 0.1f * float(i) - 1.0f;
        const luxel::Image back = gpu().read(gpu().upload_image(image, "image"));
        ASSERT_EQ(back.channels, channels == 3 ? 4 : channels);
        for (int y = 0; y < 3; ++y) {
            for (int x = 0; x < 5; ++x) {
                for (int c = 0; c < channels; ++c) ASSERT_EQ(back.at(x, y)[c], image.at(x, y)[c]);
                ASSERT_EQ(back.at(x, y)[back.channels - 1],
                          channels == 3 ? 1.0f : image.at(x, y)[channels - 1]);
            }
        }
    }
}

// Clear, then read: every format that the table has and the device can clear.
TEST_F(GpuResources, FormatsAreDecoded) {
    struct Case {
        VkFormat format;
        std::array<float, 4> value, expected;
    };
    const Case cases[] = {
        {VK_FORMAT_R8_UNORM, {0.2f}, {51.0f / 255.0f}},
        {VK_FORMAT_R8G8B8A8_UNORM, {0, 0.2f, 0.4f, 1}, {0, 51.0f / 255.0f, 102.0f / 255.0f, 1}},
        {VK_FORMAT_R8G8B8A8_SRGB, {0, 1, 0, 1}, {0, 1, 0, 1}},
        {VK_FORMAT_R8G8B8A8_UINT, {7, 8, 9, 255}, {7, 8, 9, 255}},
        {VK_FORMAT_R16_SFLOAT, {-1.5f}, {-1.5f}},
        {VK_FORMAT_R16G16_SFLOAT, {0.25f, 1024}, {0.25f, 1024}},
        {VK_FORMAT_R16G16B16A16_SFLOAT, {1, -2, 0.5f, 60000}, {1, -2, 0.5f, 60000}},
        {VK_FORMAT_R16G16B16A16_UNORM, {1, 0, 1, 0}, {1, 0, 1, 0}},
        {VK_FORMAT_R16_UINT, {4711}, {4711}},
        {VK_FORMAT_R32_UINT, {70000}, {70000}},
        {VK_FORMAT_R32_SINT, {-70000}, {-70000}},
        {VK_FORMAT_R32G32_SFLOAT, {0.1f, -1e9f}, {0.1f, -1e9f}},
        {VK_FORMAT_R32G32B32A32_UINT, {1, 2, 3, 4}, {1, 2, 3, 4}},
        {VK_FORMAT_B10G11R11_UFLOAT_PACK32, {1, 0.5f, 2, 0}, {1, 0.5f, 2, 1}},
        {VK_FORMAT_A2B10G10R10_UNORM_PACK32, {1, 0, 1, 1}, {1, 0, 1, 1}},
    };
    for (const Case& c : cases) {
        const Image image = gpu().image({.width = 3, .height = 2, .format = c.format}, "image");
        Recorder recorder(gpu());
        recorder.clear(image, c.value);
        recorder.submit();
        const luxel::Image back = gpu().read(image);
        for (int i = 0; i < back.channels; ++i)
            EXPECT_FLOAT_EQ(back.at(2, 1)[i], c.expected[std::size_t(i)]) << "VkFormat " << c.format;
    }
}

TEST_F(GpuResources, MipsAreMeansOfTheirFour) {
    const std::vector<float> texels = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    const Image image =
        gpu().upload_image({.width = 4, .height = 4, .format = VK_FORMAT_R32_SFLOAT, .mips = 3},
                           std::as_bytes(std::span(texels)), "mips");
    EXPECT_EQ(image.mip(1).width(), 2u);
    const luxel::Image half = gpu().read(image.mip(1)), one = gpu().read(image.mip(2));
    EXPECT_EQ(half.data, (std::vector<float>{2.5f, 4.5f, 10.5f, 12.5f}));
    EXPECT_EQ(one.data, (std::vector<float>{7.5f}));
}

TEST_F(GpuResources, MemoryIsCounted) {
    const std::uint64_t before = gpu().memory().now;
    gpu().reset_memory_peak();
    {
        const Image a = gpu().image({.width = 256, .height = 256}, "a"); // 1 MiB of RGBA32F
        const Buffer b = gpu().buffer(1u << 20, "b");
        EXPECT_GE(a.bytes(), 1u << 20);
        EXPECT_GE(gpu().memory().now, before + (2u << 20));
        EXPECT_LT(gpu().memory().now, before + (3u << 20));
    }
    EXPECT_EQ(gpu().memory().now, before);
    EXPECT_GE(gpu().memory().peak, before + (2u << 20));
    gpu().reset_memory_peak();
    EXPECT_EQ(gpu().memory().peak, before);
}

TEST_F(GpuResources, WhatNobodyHoldsIsUsedAgain) {
    const ImageInfo info{.width = 37, .height = 19, .format = VK_FORMAT_R16_SFLOAT};
    Image first = gpu().image(info, "first");
    const VkImage image = first.data_->storage.image;
    const Image second = gpu().image(info, "second");
    EXPECT_NE(second.data_->storage.image, image);
    first = {};
    const Image third = gpu().image(info, "third");
    EXPECT_EQ(third.data_->storage.image, image);
    EXPECT_EQ(third.name(), "third");

    // Not while recorded work needs it.
    Recorder recorder(gpu());
    {
        const Image fourth = gpu().image({.width = 41}, "fourth");
        recorder.clear(fourth, {});
    }
    const Image fifth = gpu().image({.width = 41}, "fifth");
    recorder.clear(fifth, {});
    recorder.submit();
    const Image sixth = gpu().image({.width = 41}, "sixth");
    EXPECT_NE(sixth.data_->storage.image, fifth.data_->storage.image);
}

TEST_F(GpuResources, HandlesMayOutliveTheirGpu) {
    Image image;
    Buffer buffer;
    std::shared_ptr<MessageLog> log;
    {
        Gpu other({.validation = true});
        log = other.data().context->log;
        image = other.image({.width = 4, .height = 4}, "image");
        buffer = other.buffer(64, "buffer");
    }
    image = {};
    buffer = {};
    EXPECT_EQ(log->messages, std::vector<std::string>());
}

TEST_F(GpuResources, WhatCannotBeHadIsAnError) {
    const auto fault_of = [&](auto&& f) {
        try {
            f();
        } catch (const Error& e) {
            EXPECT_NE(std::string(e.what()).find("monster"), std::string::npos) << e.what();
            return int(e.fault());
        }
        return 0;
    };
    const std::uint32_t side = gpu().data().context->properties.limits.maxImageDimension2D + 1;
    EXPECT_EQ(fault_of([&] { gpu().image({.width = side, .height = 1}, "monster"); }), int(Fault::resource));
    EXPECT_EQ(fault_of([&] { gpu().buffer(1ull << 50, "monster"); }), int(Fault::resource));
    EXPECT_EQ(fault_of([&] { check(VK_ERROR_DEVICE_LOST, "vkQueueSubmit2(...)", "monster"); }),
              int(Fault::device_lost));
}

// A device of 4 MiB: what is free makes room before anything fails, and a failure leaves all as it was.
TEST_F(GpuResources, ShortageEmptiesThePoolFirst) {
    Gpu small({.validation = true});
    small.data().context->memory_limit = 4u << 20;
    { const Buffer free = small.buffer(3u << 20, "free"); }
    const Buffer kept = small.buffer(2u << 20, "kept");
    const std::uint64_t before = small.memory().now;
    try {
        small.buffer(3u << 20, "too much");
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.fault(), Fault::resource);
        EXPECT_NE(
            std::string(e.what()).find("too much: 3 MiB of device memory cannot be had (2 MiB are in use)"),
            std::string::npos)
            << e.what();
    }
    EXPECT_EQ(small.memory().now, before);
    EXPECT_TRUE(small.validation_messages().empty());
}

using GpuDeathTest = GpuResources;
TEST_F(GpuDeathTest, MisuseIsABug) {
    ::testing::FLAGS_gtest_death_test_style = "threadsafe";
    EXPECT_DEATH(gpu().image({.width = 0}, "flat"), "image flat of 0x1");
    EXPECT_DEATH(gpu().image({.width = 4, .height = 4, .layers = 5, .cube = true}, "box"), "cube box");
    EXPECT_DEATH(gpu().image({}, "single").mip(1), "mip 1 of image single");
    EXPECT_DEATH(gpu().read(gpu().image({}, "blank")), "blank.*read before anything was written");
    EXPECT_DEATH(gpu().write(gpu().buffer(16, "far"), {}), "far is not Memory::upload");
}

} // namespace
} // namespace luxel::gpu
