// SPDX-License-Identifier: MIT
// The handles: what is selected of an image, and the views that shaders see.
#include <algorithm>

#include "gpu/check.h"
#include "gpu/context.h"
#include "gpu/format.h"

namespace luxel::gpu {

const ImageInfo& Image::info() const { return data_->storage.info; }
const std::string& Image::name() const { return data_->name; }
std::uint32_t Image::width() const { return std::max(1u, info().width >> first_mip); }
std::uint32_t Image::height() const { return std::max(1u, info().height >> first_mip); }
std::uint64_t Image::bytes() const { return data_->storage.bytes; }

Image Image::mip(std::uint32_t level) const {
    const Range range = range_of(*this);
    LUXEL_ASSERT(level < range.mips, "mip {} of image {} with {}", level, name(), range.mips);
    Image part = *this;
    part.first_mip = first_mip + level;
    part.mip_count = 1;
    return part;
}

Image Image::layer(std::uint32_t index) const {
    const Range range = range_of(*this);
    LUXEL_ASSERT(index < range.layers, "layer {} of image {} with {}", index, name(), range.layers);
    Image part = *this;
    part.first_layer = first_layer + index;
    part.layer_count = 1;
    part.single_layer = true;
    return part;
}

std::uint64_t Buffer::size() const { return data_->size; }
const std::string& Buffer::name() const { return data_->name; }

Range range_of(const Image& image) {
    const ImageInfo& info = image.info();
    return {.first_mip = image.first_mip,
            .mips = image.mip_count ? image.mip_count : info.mips - image.first_mip,
            .first_layer = image.first_layer,
            .layers = image.layer_count ? image.layer_count : info.layers - image.first_layer};
}

VkImageAspectFlags aspect_of(VkFormat format) {
    return format_info(format).depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

// A depth image may be tested and sampled by the same pass, so it has one layout for both.
VkImageLayout sampled_layout(VkFormat format) {
    return format_info(format).depth ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL
                                     : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
}

VkImageView view_of(const Image& image, VkImageViewType type) {
    ImageData& data = *image.data_;
    const Range r = range_of(image);
    VkImageView& view =
        data.storage.views[ImageStorage::ViewKey{type, r.first_mip, r.mips, r.first_layer, r.layers}];
    if (view) return view;
    const VkImageViewCreateInfo create{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                       .image = data.storage.image,
                                       .viewType = type,
                                       .format = data.storage.info.format,
                                       .subresourceRange = {aspect_of(data.storage.info.format), r.first_mip,
                                                            r.mips, r.first_layer, r.layers}};
    LUXEL_VK(vkCreateImageView(data.context->device, &create, nullptr, &view), data.name);
    return view;
}

VkBufferView texel_view_of(const Buffer& buffer, VkFormat format) {
    BufferData& data = *buffer.data_;
    const std::uint64_t texel = std::uint64_t(format_info(format).texel_bytes);
    const std::uint64_t texels = data.storage.capacity / texel;
    const std::uint64_t most = data.context->properties.limits.maxTexelBufferElements;
    if (texels > most)
        fail(Fault::resource, "gpu: {}: {} texels, but {} allows {} in a texel buffer", data.name, texels,
             data.context->info.name, most);

    VkBufferView& view = data.storage.texel_views[format];
    if (view) return view;
    const VkBufferViewCreateInfo create{.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                        .buffer = data.storage.buffer,
                                        .format = format,
                                        .range = texels * texel};
    LUXEL_VK(vkCreateBufferView(data.context->device, &create, nullptr, &view), data.name);
    return view;
}

} // namespace luxel::gpu
