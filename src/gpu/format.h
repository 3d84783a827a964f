// SPDX-License-Identifier: MIT
// What luxel knows about the pixel formats that it uses.
#pragma once
#include <functional>
#include <string>
#include <string_view>

#include <vulkan/vulkan.h>

namespace luxel::gpu {

enum class Numbers { float_, uint_, int_ }; // what a shader sees

struct FormatInfo {
    VkFormat format;
    std::string_view name;
    int channels;
    int texel_bytes;
    Numbers numbers;
    bool depth = false;
};

// Assertion for a format that is not in the table.
const FormatInfo& format_info(VkFormat format);

// What luxel's passes do with a format, beyond copies, and whether the device can: "" or the first use that
// is missing, as a phrase ("linear filtering of RGBA32F images"). can: the features of a format in optimal
// tiling.
std::string missing_format_use(const std::function<VkFormatFeatureFlags(VkFormat)>& can);

} // namespace luxel::gpu
