// SPDX-License-Identifier: MIT
// Which VkResult is whose fault.
#include "gpu/check.h"

#include <string_view>

namespace luxel::gpu {

void check(VkResult result, const char* call, const std::string& what) {
    if (result == VK_SUCCESS) return;
    const std::string_view text(call);
    const std::string_view function = text.substr(0, text.find('('));
    switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_FRAGMENTED_POOL:
    case VK_ERROR_TOO_MANY_OBJECTS:
        fail(Fault::resource, "gpu: {}: {} is out of memory ({})", what, function, int(result));
    case VK_ERROR_DEVICE_LOST:
        fail(Fault::device_lost, "gpu: {}: the device was lost in {}", what, function);
    default:
        LUXEL_ASSERT(result == VK_SUCCESS, "{} returned {} for {}", function, int(result), what);
    }
}

} // namespace luxel::gpu
