// SPDX-License-Identifier: MIT
// What luxel knows about the pixel formats that it uses.
#pragma once
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

} // namespace luxel::gpu
