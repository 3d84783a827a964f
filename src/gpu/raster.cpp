// SPDX-License-Identifier: MIT
// Draws: one dynamic rendering per pass.
#include "gpu/check.h"
#include "gpu/recorder_data.h"

namespace luxel::gpu {
namespace {

RasterState state_of(const RasterPass& pass) {
    RasterState state;
    for (const ColorTarget& target : pass.color) {
        state.color_formats.push_back(target.image.info().format);
        state.blends.push_back(target.blend);
    }
    if (pass.depth) {
        state.depth_format = pass.depth->image.info().format;
        state.depth_write = pass.depth->write;
        state.depth_compare = pass.depth->compare;
    }
    state.depth_clamp = pass.depth_clamp;
    state.depth_bias = pass.depth_bias != 0.0f || pass.depth_bias_slope != 0.0f;
    state.cull = pass.cull;
    state.topology = pass.topology;
    return state;
}

VkImageLayout depth_layout(const DepthTarget& target) {
    const bool writes = target.write || target.clear.has_value();
    return writes ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                  : sampled_layout(target.image.info().format);
}

// A view of one mip, as many layers as the pass draws to.
VkImageView target_view(const Image& image, std::uint32_t layers) {
    return view_of(image, layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D);
}

VkExtent2D check_targets(const std::string& program, const RasterPass& pass) {
    LUXEL_ASSERT(!pass.color.empty() || pass.depth, "{} draws to nothing", program);
    const Image& first = pass.color.empty() ? pass.depth->image : pass.color[0].image;
    const auto check_target = [&](const Image& image, VkImageUsageFlags usage) {
        const Range range = range_of(image);
        LUXEL_ASSERT(image.width() == first.width() && image.height() == first.height() && range.mips == 1 &&
                         range.layers == pass.layers,
                     "{}: target {} is {}x{} with {} mips and {} layers; the pass has {}x{}, 1 and {}",
                     program, image.name(), image.width(), image.height(), range.mips, range.layers,
                     first.width(), first.height(), pass.layers);
        LUXEL_ASSERT(image.data_->storage.usage & usage, "{}: target {} has a format that cannot be drawn to",
                     program, image.name());
    };
    for (const ColorTarget& t : pass.color) check_target(t.image, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
    if (pass.depth) check_target(pass.depth->image, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    return {first.width(), first.height()};
}

void use_targets(Commands& commands, const RasterPass& pass) {
    for (const ColorTarget& t : pass.color)
        commands.use(t.image, use::color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, !t.clear);
    if (!pass.depth) return;
    const bool writes = pass.depth->write || pass.depth->clear;
    commands.use(pass.depth->image, writes ? use::depth_write : use::depth_read, depth_layout(*pass.depth),
                 !pass.depth->clear);
}

void begin_rendering(VkCommandBuffer buffer, const RasterPass& pass, VkExtent2D size) {
    std::vector<VkRenderingAttachmentInfo> colors;
    for (const ColorTarget& t : pass.color) {
        VkRenderingAttachmentInfo a{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                    .imageView = target_view(t.image, pass.layers),
                                    .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                    .loadOp =
                                        t.clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD,
                                    .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
        if (t.clear) a.clearValue.color = clear_value(t.image.info().format, *t.clear);
        colors.push_back(a);
    }
    VkRenderingAttachmentInfo depth{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    if (pass.depth) {
        const DepthTarget& t = *pass.depth;
        const bool writes = t.write || t.clear;
        depth.imageView = target_view(t.image, pass.layers);
        depth.imageLayout = depth_layout(t);
        depth.loadOp = t.clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
        depth.storeOp = writes ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_NONE;
        depth.clearValue.depthStencil.depth = t.clear.value_or(1.0f);
    }
    const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                    .renderArea = {.extent = size},
                                    .layerCount = pass.layers,
                                    .colorAttachmentCount = std::uint32_t(colors.size()),
                                    .pColorAttachments = colors.data(),
                                    .pDepthAttachment = pass.depth ? &depth : nullptr};
    vkCmdBeginRendering(buffer, &rendering);

    // The y axis points up in clip space, as it does in the world.
    const VkViewport viewport{
        .y = float(size.height), .width = float(size.width), .height = -float(size.height), .maxDepth = 1.0f};
    const VkRect2D scissor{.extent = size};
    vkCmdSetViewport(buffer, 0, 1, &viewport);
    vkCmdSetScissor(buffer, 0, 1, &scissor);
    vkCmdSetDepthBias(buffer, pass.depth_bias, 0.0f, pass.depth_bias_slope);
}

} // namespace

void Recorder::draw_bytes(std::string_view name, const RasterPass& pass, std::span<const std::byte> params,
                          const Bindings& bindings, const Buffer& indices, std::span<const Batch> batches) {
    Program& program = gpu_.data().program(name);
    LUXEL_ASSERT(!program.compute, "{} is a compute shader", name);
    LUXEL_ASSERT(program.color_outputs <= pass.color.size(),
                 "{} writes {} colors but the pass has {} targets", name, program.color_outputs,
                 pass.color.size());
    check_params(program, params);
    const VkExtent2D size = check_targets(program.name, pass);

    // Everything that any batch touches has to be in place before the rendering begins.
    Commands& commands = data_->commands;
    data_->use_bindings(program, 0, bindings);
    for (const Batch& batch : batches) data_->use_bindings(program, 1, batch.bindings);
    use_targets(commands, pass);
    if (indices) commands.use(indices, use::index, true);
    commands.begin(program.name);

    const VkCommandBuffer buffer = commands.buffer();
    begin_rendering(buffer, pass, size);
    vkCmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, program.raster_pipeline(state_of(pass)));
    data_->bind_set(VK_PIPELINE_BIND_POINT_GRAPHICS, program, 0, params, bindings);
    if (indices) vkCmdBindIndexBuffer(buffer, indices.data_->storage.buffer, 0, VK_INDEX_TYPE_UINT32);
    for (const Batch& batch : batches) {
        if (batch.draws.empty()) continue;
        data_->bind_set(VK_PIPELINE_BIND_POINT_GRAPHICS, program, 1, {}, batch.bindings);
        for (const Draw& d : batch.draws) {
            if (!indices) {
                vkCmdDraw(buffer, d.count, d.instances, d.first, d.instance);
                continue;
            }
            LUXEL_ASSERT((std::uint64_t(d.first) + d.count) * 4 <= indices.size(),
                         "{}: indices {} to {} of {} bytes of {}", name, d.first, d.first + d.count,
                         indices.size(), indices.name());
            vkCmdDrawIndexed(buffer, d.count, d.instances, d.first, d.vertex_offset, d.instance);
        }
    }
    vkCmdEndRendering(buffer);
    commands.end();
}

} // namespace luxel::gpu
