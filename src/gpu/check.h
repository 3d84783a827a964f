// SPDX-License-Identifier: MIT
// Vulkan results as errors: none is dropped.
#pragma once
#include <string>

#include <vulkan/vulkan.h>

#include "core/error.h"

namespace luxel::gpu {

// Memory shortage is Fault::resource, a lost device Fault::device_lost, anything else a bug.
void check(VkResult result, const char* call, const std::string& what);

#define LUXEL_VK(call, ...) ::luxel::gpu::check(call, #call, __VA_ARGS__)

} // namespace luxel::gpu
