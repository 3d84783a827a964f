// SPDX-License-Identifier: MIT
#include "gpu/format.h"

#include <vector>

#include <fmt/format.h>

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

struct FormatUse {
    VkFormatFeatureFlags feature;
    std::string_view name;
};
constexpr FormatUse sampling{VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT, "sampling"};
constexpr FormatUse filtering{VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT, "linear filtering"};
constexpr FormatUse storing{VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, "storage"};
constexpr FormatUse counting{VK_FORMAT_FEATURE_STORAGE_IMAGE_ATOMIC_BIT, "atomic operations"};
constexpr FormatUse drawing{VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, "drawing"};
constexpr FormatUse blending{VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT, "blending"};
constexpr FormatUse depth_testing{VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT, "depth tests"};
constexpr FormatUse scaling{VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_BLIT_DST_BIT, "scaled copies"};

// Textures, the G-buffer, sums of light, distance cubes and their mips, caustics' splats, lists of fragments,
// depth.
struct FormatUses {
    VkFormat format;
    std::vector<FormatUse> uses;
};
const std::vector<FormatUses>& format_uses() {
    static const std::vector<FormatUses> uses = {
        {VK_FORMAT_R8_UNORM, {sampling, filtering}},
        {VK_FORMAT_R8G8B8A8_UNORM, {sampling, filtering, scaling}},
        {VK_FORMAT_R8G8B8A8_SRGB, {sampling, filtering, scaling}},
        {VK_FORMAT_R16G16B16A16_SFLOAT, {sampling, filtering, drawing, storing}},
        {VK_FORMAT_R32_UINT, {sampling, storing, counting}},
        {VK_FORMAT_R32_SFLOAT, {sampling, filtering, drawing, storing, scaling}},
        {VK_FORMAT_R32G32_SFLOAT, {sampling, filtering, drawing, storing, scaling}},
        {VK_FORMAT_R32G32B32A32_SFLOAT, {sampling, filtering, drawing, blending, storing, scaling}},
        {VK_FORMAT_D32_SFLOAT, {sampling, depth_testing}}};
    return uses;
}

} // namespace

std::string missing_format_use(const std::function<VkFormatFeatureFlags(VkFormat)>& can) {
    for (const FormatUses& f : format_uses())
        for (const FormatUse& use : f.uses)
            if ((can(f.format) & use.feature) != use.feature)
                return fmt::format("{} of {} images", use.name, format_info(f.format).name);
    return "";
}

const FormatInfo& format_info(VkFormat format) {
    const FormatInfo* found = nullptr;
    for (const FormatInfo& f : table) {
        if (f.format == format) found = &f;
    }
    LUXEL_ASSERT(found, "VkFormat {} is not in gpu/format.cpp", int(format));
    return *found;
}

} // namespace luxel::gpu
