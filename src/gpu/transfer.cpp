// SPDX-License-Identifier: MIT
// Clears, fills, copies and mips.
#include <cmath>

#include "gpu/check.h"
#include "gpu/recorder_data.h"

namespace luxel::gpu {
namespace {

VkImageSubresourceLayers layers_of(const Image& image) {
    const Range r = range_of(image);
    return {aspect_of(image.info().format), r.first_mip, r.first_layer, r.layers};
}

VkBufferImageCopy2 whole_image(const Image& image) {
    return {.sType = VK_STRUCTURE_TYPE_BUFFER_IMAGE_COPY_2,
            .imageSubresource = layers_of(image),
            .imageExtent = {image.width(), image.height(), 1}};
}

void use_source(Commands& commands, const Image& image) {
    commands.use(image, use::transfer_read, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, true);
}

void use_target(Commands& commands, const Image& image) {
    commands.use(image, use::transfer_write, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, false);
}

void blit(Commands& commands, const Image& from, const Image& to, VkFilter filter) {
    const VkImageBlit2 region{
        .sType = VK_STRUCTURE_TYPE_IMAGE_BLIT_2,
        .srcSubresource = layers_of(from),
        .srcOffsets = {{}, {std::int32_t(from.width()), std::int32_t(from.height()), 1}},
        .dstSubresource = layers_of(to),
        .dstOffsets = {{}, {std::int32_t(to.width()), std::int32_t(to.height()), 1}}};
    const VkBlitImageInfo2 info{.sType = VK_STRUCTURE_TYPE_BLIT_IMAGE_INFO_2,
                                .srcImage = from.data_->storage.image,
                                .srcImageLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                .dstImage = to.data_->storage.image,
                                .dstImageLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                .regionCount = 1,
                                .pRegions = &region,
                                .filter = filter};
    vkCmdBlitImage2(commands.buffer(), &info);
}

} // namespace

VkClearColorValue clear_value(VkFormat format, std::array<float, 4> value) {
    VkClearColorValue clear{};
    for (std::size_t i = 0; i < 4; ++i) {
        switch (format_info(format).numbers) {
        case Numbers::float_:
            clear.float32[i] = value[i];
            break;
        case Numbers::uint_:
            clear.uint32[i] = std::uint32_t(std::llround(value[i]));
            break;
        case Numbers::int_:
            clear.int32[i] = std::int32_t(std::lround(value[i]));
            break;
        }
    }
    return clear;
}

void copy_buffer_to_image(Commands& commands, const Buffer& from, const Image& to) {
    commands.use(from, use::transfer_read, false);
    use_target(commands, to);
    commands.begin("write " + to.name());
    const VkBufferImageCopy2 region = whole_image(to);
    const VkCopyBufferToImageInfo2 info{.sType = VK_STRUCTURE_TYPE_COPY_BUFFER_TO_IMAGE_INFO_2,
                                        .srcBuffer = from.data_->storage.buffer,
                                        .dstImage = to.data_->storage.image,
                                        .dstImageLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                        .regionCount = 1,
                                        .pRegions = &region};
    vkCmdCopyBufferToImage2(commands.buffer(), &info);
    commands.end();
}

void copy_image_to_buffer(Commands& commands, const Image& from, const Buffer& to) {
    use_source(commands, from);
    commands.use(to, use::transfer_write, false);
    commands.begin("read " + from.name());
    const VkBufferImageCopy2 region = whole_image(from);
    const VkCopyImageToBufferInfo2 info{.sType = VK_STRUCTURE_TYPE_COPY_IMAGE_TO_BUFFER_INFO_2,
                                        .srcImage = from.data_->storage.image,
                                        .srcImageLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                        .dstBuffer = to.data_->storage.buffer,
                                        .regionCount = 1,
                                        .pRegions = &region};
    vkCmdCopyImageToBuffer2(commands.buffer(), &info);
    commands.end();
}

void copy_buffer(Commands& commands, const Buffer& from, std::uint64_t from_offset, const Buffer& to,
                 std::uint64_t size) {
    commands.use(from, use::transfer_read, from.data_->storage.kind != Memory::upload);
    commands.use(to, use::transfer_write, false);
    commands.begin("copy " + from.name());
    const VkBufferCopy2 region{
        .sType = VK_STRUCTURE_TYPE_BUFFER_COPY_2, .srcOffset = from_offset, .size = size};
    const VkCopyBufferInfo2 info{.sType = VK_STRUCTURE_TYPE_COPY_BUFFER_INFO_2,
                                 .srcBuffer = from.data_->storage.buffer,
                                 .dstBuffer = to.data_->storage.buffer,
                                 .regionCount = 1,
                                 .pRegions = &region};
    vkCmdCopyBuffer2(commands.buffer(), &info);
    commands.end();
}

void blit_mips(Commands& commands, const Image& image) {
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(commands.context().physical, image.info().format, &properties);
    constexpr VkFormatFeatureFlags needed = VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_BLIT_DST_BIT |
                                            VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    LUXEL_ASSERT((properties.optimalTilingFeatures & needed) == needed,
                 "{} of image {} cannot be blitted to mips", format_info(image.info().format).name,
                 image.name());
    for (std::uint32_t level = 1; level < range_of(image).mips; ++level) {
        const Image from = image.mip(level - 1), to = image.mip(level);
        use_source(commands, from);
        use_target(commands, to);
        commands.begin(fmt::format("mip {} of {}", level, image.name()));
        blit(commands, from, to, VK_FILTER_LINEAR);
        commands.end();
    }
}

void Recorder::clear(const Image& image, std::array<float, 4> value) {
    LUXEL_ASSERT(!format_info(image.info().format).depth, "depth image {} is cleared by its pass",
                 image.name());
    Commands& commands = data_->commands;
    use_target(commands, image);
    commands.begin("clear " + image.name());
    const Range r = range_of(image);
    const VkImageSubresourceRange range{VK_IMAGE_ASPECT_COLOR_BIT, r.first_mip, r.mips, r.first_layer,
                                        r.layers};
    const VkClearColorValue color = clear_value(image.info().format, value);
    vkCmdClearColorImage(commands.buffer(), image.data_->storage.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                         &color, 1, &range);
    commands.end();
}

void Recorder::fill(const Buffer& buffer, std::uint32_t word) {
    Commands& commands = data_->commands;
    commands.use(buffer, use::transfer_write, false);
    commands.begin("fill " + buffer.name());
    vkCmdFillBuffer(commands.buffer(), buffer.data_->storage.buffer, 0, VK_WHOLE_SIZE, word);
    commands.end();
}

void Recorder::copy(const Image& from, const Image& to) {
    const Range source = range_of(from), target = range_of(to);
    LUXEL_ASSERT(from.width() == to.width() && from.height() == to.height() &&
                     source.layers == target.layers && source.mips == target.mips,
                 "copy of {} ({}x{}, {} layers, {} mips) to {} ({}x{}, {}, {})", from.name(), from.width(),
                 from.height(), source.layers, source.mips, to.name(), to.width(), to.height(), target.layers,
                 target.mips);
    const FormatInfo &a = format_info(from.info().format), &b = format_info(to.info().format);
    Commands& commands = data_->commands;

    // Depth and color do not mix in one command; through a buffer they do, bit by bit.
    for (std::uint32_t m = 0; m < source.mips; ++m) {
        const Image from_mip = from.mip(m), to_mip = to.mip(m);
        if (a.depth != b.depth) {
            LUXEL_ASSERT(a.texel_bytes == b.texel_bytes && a.channels == b.channels,
                         "copy of {} in {} to {} in {}", from.name(), a.name, to.name(), b.name);
            const Buffer between = gpu_.buffer(std::uint64_t(from_mip.width()) * from_mip.height() *
                                                   source.layers * std::uint64_t(a.texel_bytes),
                                               from.name() + " in between");
            copy_image_to_buffer(commands, from_mip, between);
            copy_buffer_to_image(commands, between, to_mip);
            continue;
        }
        // Equal formats are copied, others converted.
        use_source(commands, from_mip);
        use_target(commands, to_mip);
        commands.begin(fmt::format("copy {} to {}", from.name(), to.name()));
        if (a.format != b.format) {
            blit(commands, from_mip, to_mip, VK_FILTER_NEAREST);
        } else {
            const VkImageCopy2 region{.sType = VK_STRUCTURE_TYPE_IMAGE_COPY_2,
                                      .srcSubresource = layers_of(from_mip),
                                      .dstSubresource = layers_of(to_mip),
                                      .extent = {from_mip.width(), from_mip.height(), 1}};
            const VkCopyImageInfo2 info{.sType = VK_STRUCTURE_TYPE_COPY_IMAGE_INFO_2,
                                        .srcImage = from.data_->storage.image,
                                        .srcImageLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                        .dstImage = to.data_->storage.image,
                                        .dstImageLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                        .regionCount = 1,
                                        .pRegions = &region};
            vkCmdCopyImage2(commands.buffer(), &info);
        }
        commands.end();
    }
}

void Recorder::generate_mips(const Image& image) { blit_mips(data_->commands, image); }

} // namespace luxel::gpu
