// SPDX-License-Identifier: MIT
#include "gpu/format.h"

#include "core/error.h"

namespace luxel::gpu {
namespace {

constexpr auto F = Numbers::float_;
constexpr auto U = Numbers::uint_;
constexpr auto I = Numbers::int_;

constexpr FormatInfo table[] = {
    {VK_FORMAT_R8_UNORM, "R8", 1, 1, F},
    {VK_FORMAT_R8G8_UNORM, "RG8", 2, 2, F},
    {VK_FORMAT_R8G8B8A8_UNORM, "RGBA8", 4, 4, F},
    {VK_FORMAT_R8G8B8A8_SRGB, "RGBA8 sRGB", 4, 4, F},
    {VK_FORMAT_R8_UINT, "R8UI", 1, 1, U},
    {VK_FORMAT_R8G8B8A8_UINT, "RGBA8UI", 4, 4, U},
    {VK_FORMAT_R16_UNORM, "R16", 1, 2, F},
    {VK_FORMAT_R16G16B16A16_UNORM, "RGBA16", 4, 8, F},
    {VK_FORMAT_R16_UINT, "R16UI", 1, 2, U},
    {VK_FORMAT_R16G16B16A16_UINT, "RGBA16UI", 4, 8, U},
    {VK_FORMAT_R16_SFLOAT, "R16F", 1, 2, F},
    {VK_FORMAT_R16G16_SFLOAT, "RG16F", 2, 4, F},
    {VK_FORMAT_R16G16B16A16_SFLOAT, "RGBA16F", 4, 8, F},
    {VK_FORMAT_R32_UINT, "R32UI", 1, 4, U},
    {VK_FORMAT_R32_SINT, "R32I", 1, 4, I},
    {VK_FORMAT_R32G32_UINT, "RG32UI", 2, 8, U},
    {VK_FORMAT_R32G32B32A32_UINT, "RGBA32UI", 4, 16, U},
    {VK_FORMAT_R32_SFLOAT, "R32F", 1, 4, F},
    {VK_FORMAT_R32G32_SFLOAT, "RG32F", 2, 8, F},
    {VK_FORMAT_R32G32B32A32_SFLOAT, "RGBA32F", 4, 16, F},
    {VK_FORMAT_B10G11R11_UFLOAT_PACK32, "R11G11B10F", 4, 4, F},
    {VK_FORMAT_A2B10G10R10_UNORM_PACK32, "RGB10A2", 4, 4, F},
    {VK_FORMAT_D32_SFLOAT, "D32F", 1, 4, F, true},
};

} // namespace

const FormatInfo& format_info(VkFormat format) {
    const FormatInfo* found = nullptr;
    for (const FormatInfo& f : table) {
        if (f.format == format) found = &f;
    }
    LUXEL_ASSERT(found, "VkFormat {} is not in gpu/format.cpp", int(format));
    return *found;
}

} // namespace luxel::gpu
