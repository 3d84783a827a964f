// SPDX-License-Identifier: MIT
// What a shader says about its own interface, read from its SPIR-V.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "gpu/format.h"

namespace luxel::gpu {

struct ShaderBinding {
    std::string name;  // of the variable; "" for a block without an instance name
    std::string block; // of the block type; "" for images
    std::uint32_t set = 0, binding = 0;
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_MAX_ENUM;
    bool used = false;                 // false: declared only
    bool reads = true, writes = false; // as declared by readonly and writeonly
    std::uint64_t block_size = 0;      // bytes of a uniform block
    VkImageViewType view = VK_IMAGE_VIEW_TYPE_MAX_ENUM;
    Numbers numbers = Numbers::float_;     // of an image or texel buffer
    VkFormat format = VK_FORMAT_UNDEFINED; // of a storage image with a format
};

struct Reflection {
    VkShaderStageFlagBits stage = VK_SHADER_STAGE_COMPUTE_BIT;
    std::array<std::uint32_t, 3> local_size{1, 1, 1};
    std::vector<ShaderBinding> bindings;
    std::uint32_t color_outputs = 0; // fragment shaders: highest location + 1
};

// name is for messages: what the parser does not know is a bug in the shader.
Reflection reflect(std::span<const std::uint32_t> words, const std::string& name);

} // namespace luxel::gpu
