// SPDX-License-Identifier: MIT
#include "techniques/frame/texture_upload.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "scene/texture_filter.h"
#include "techniques/frame/texture_levels.h"

namespace luxel {
namespace {

template <class Number> void append(std::vector<std::byte>& texels, Number value) {
    const std::size_t at = texels.size();
    texels.resize(at + sizeof value);
    std::memcpy(&texels[at], &value, sizeof value);
}

template <class Code> Code code_of(float value) {
    constexpr float largest = float(std::numeric_limits<Code>::max());
    return Code(std::lround(std::clamp(value, 0.0f, 1.0f) * largest));
}

void append(std::vector<std::byte>& texels, const Image& level, VkFormat format) {
    for (std::size_t i = 0; i < level.data.size(); ++i) {
        const float value = level.data[i];
        if (format == VK_FORMAT_R32G32B32A32_SFLOAT) append(texels, value);
        if (format == VK_FORMAT_R16G16B16A16_UNORM) append(texels, code_of<std::uint16_t>(value));
        if (format == VK_FORMAT_R8G8B8A8_UNORM) append(texels, code_of<std::uint8_t>(value));
        if (format == VK_FORMAT_R8G8B8A8_SRGB)
            append(texels,
                   code_of<std::uint8_t>(i % 4 < 3 ? srgb_encode(std::clamp(value, 0.0f, 1.0f)) : value));
    }
}

VkFormat format_of(const gpu::Gpu& gpu, const Texture& texture) {
    if (!texture.pixels.is_wide()) return texture.srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM;
    const bool kept = !texture.srgb && gpu.can_filter(VK_FORMAT_R16G16B16A16_UNORM);
    return kept ? VK_FORMAT_R16G16B16A16_UNORM : VK_FORMAT_R32G32B32A32_SFLOAT;
}

} // namespace

gpu::Image upload_texture(gpu::Gpu& gpu, const Texture& texture, bool mipmaps, std::optional<float> cutoff) {
    const Pixels& p = texture.pixels;
    gpu::ImageInfo info{.width = std::uint32_t(p.width),
                        .height = std::uint32_t(p.height),
                        .format = format_of(gpu, texture)};
    if (mipmaps) info.mips = std::uint32_t(std::bit_width(std::max(info.width, info.height)));
    const std::string name = "texture " + texture.name;
    if (!p.is_wide() && (!mipmaps || !cutoff))
        return gpu.upload_image(info, std::as_bytes(std::span(p.rgba)), name);

    std::vector<Image> levels = texture_levels(texture, mipmaps ? cutoff : std::nullopt);
    levels.resize(info.mips);
    std::vector<std::byte> texels;
    for (const Image& level : levels) append(texels, level, info.format);
    return gpu.upload_mips(info, texels, name);
}

} // namespace luxel
