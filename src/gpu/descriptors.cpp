// SPDX-License-Identifier: MIT
#include "gpu/descriptors.h"

#include <algorithm>
#include <cstring>
#include <deque>

#include "gpu/check.h"

namespace luxel::gpu {
namespace {

constexpr std::uint32_t sets_per_pool = 256;
constexpr std::uint32_t descriptors_per_set = 16; // on average; a full pool is followed by another
constexpr std::uint64_t ring_bytes = 1u << 20;

const char* numbers_name(Numbers n) {
    if (n == Numbers::float_) return "float";
    return n == Numbers::uint_ ? "uint" : "int";
}

// What can be said about an image before the driver sees it.
void check_image(const Program& program, const ProgramBinding& b, const Image& image) {
    const ShaderBinding& s = b.shader;
    const FormatInfo& format = format_info(image.info().format);
    const Range range = range_of(image);
    LUXEL_ASSERT(format.numbers == s.numbers, "{}: {} reads {} but image {} is {}", program.name, s.name,
                 numbers_name(s.numbers), image.name(), format.name);
    const bool cube = s.view == VK_IMAGE_VIEW_TYPE_CUBE || s.view == VK_IMAGE_VIEW_TYPE_CUBE_ARRAY;
    LUXEL_ASSERT(!cube || (image.info().cube && range.layers % 6 == 0),
                 "{}: {} is a cube but image {} is not ({} layers selected)", program.name, s.name,
                 image.name(), range.layers);
    LUXEL_ASSERT(s.view != VK_IMAGE_VIEW_TYPE_CUBE || range.layers == 6,
                 "{}: {} is one cube but image {} has {} layers", program.name, s.name, image.name(),
                 range.layers);
    LUXEL_ASSERT(s.view != VK_IMAGE_VIEW_TYPE_2D || range.layers == 1,
                 "{}: {} has one layer but image {} has {}", program.name, s.name, image.name(),
                 range.layers);
    if (s.type != VK_DESCRIPTOR_TYPE_STORAGE_IMAGE) return;
    LUXEL_ASSERT(range.mips == 1, "{}: {} stores to one mip but image {} has {} selected", program.name,
                 s.name, image.name(), range.mips);
    LUXEL_ASSERT(s.format == VK_FORMAT_UNDEFINED || s.format == image.info().format,
                 "{}: {} has format {} but image {} has {}", program.name, s.name, format_info(s.format).name,
                 image.name(), format.name);
    LUXEL_ASSERT(image.data_->storage.usage & VK_IMAGE_USAGE_STORAGE_BIT,
                 "{}: {} is a storage image but {} of image {} cannot be stored to", program.name, s.name,
                 format.name, image.name());
}

VkDescriptorImageInfo image_info(const GpuData& gpu, const ProgramBinding& b, const Binding& given) {
    const Image& image = std::get<Image>(given.resource);
    VkDescriptorImageInfo info{.imageView = view_of(image, b.shader.view),
                               .imageLayout = VK_IMAGE_LAYOUT_GENERAL};
    if (b.shader.type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER) {
        info.imageLayout = sampled_layout(image.info().format);
        info.sampler = gpu.samplers[std::size_t(given.sampler)];
    }
    return info;
}

VkDescriptorBufferInfo buffer_info(const Program& program, const ProgramBinding& b, const Buffer& buffer) {
    const VkPhysicalDeviceLimits& limits = program.context->properties.limits;
    const bool storage = b.shader.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    const std::uint64_t range = std::max<std::uint64_t>((buffer.size() + 3) / 4 * 4, 16);
    const std::uint64_t most = storage ? limits.maxStorageBufferRange : limits.maxUniformBufferRange;
    LUXEL_ASSERT(buffer.data_->storage.capacity >= b.shader.block_size,
                 "{}: block {} has {} bytes but buffer {} has {}", program.name, b.shader.block,
                 b.shader.block_size, buffer.name(), buffer.size());
    if (range > most && (storage || b.shader.block_size > most))
        fail(Fault::resource, "gpu: {}: {} bytes, but {} lets shaders see {} of a buffer", buffer.name(),
             range, program.context->info.name, most);
    return {.buffer = buffer.data_->storage.buffer,
            .range = storage ? range : std::max<std::uint64_t>(b.shader.block_size, 4)};
}

// Texels by what the shader reads: vec4, or one 32-bit integer.
VkFormat texel_format(Numbers numbers) {
    if (numbers == Numbers::float_) return VK_FORMAT_R32G32B32A32_SFLOAT;
    return numbers == Numbers::uint_ ? VK_FORMAT_R32_UINT : VK_FORMAT_R32_SINT;
}

} // namespace

const ProgramBinding& find_binding(const Program& program, std::uint32_t set, std::string_view name) {
    const auto found = std::find_if(program.bindings.begin(), program.bindings.end(), [&](const auto& b) {
        return b.shader.set == set && b.is(name) && &b != program.params;
    });
    LUXEL_ASSERT(found != program.bindings.end(), "{} has no binding \"{}\" in set {}", program.name, name,
                 set);
    return *found;
}

Descriptors::~Descriptors() {
    for (VkDescriptorPool pool : pools_) vkDestroyDescriptorPool(context_->device, pool, nullptr);
}

VkDescriptorSet Descriptors::allocate(const Program& program, VkDescriptorSetLayout layout) {
    for (bool fresh = false;; fresh = true) {
        if (pool_ == pools_.size()) {
            constexpr std::uint32_t n = sets_per_pool * descriptors_per_set;
            const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, n},
                                                  {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, n},
                                                  {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, n},
                                                  {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, n},
                                                  {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, n}};
            const VkDescriptorPoolCreateInfo create{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                                    .maxSets = sets_per_pool,
                                                    .poolSizeCount = 5,
                                                    .pPoolSizes = sizes};
            pools_.push_back(VK_NULL_HANDLE);
            LUXEL_VK(vkCreateDescriptorPool(context_->device, &create, nullptr, &pools_.back()),
                     program.name);
            fresh = true;
        }
        const VkDescriptorSetAllocateInfo allocation{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                                     .descriptorPool = pools_[pool_],
                                                     .descriptorSetCount = 1,
                                                     .pSetLayouts = &layout};
        VkDescriptorSet set = VK_NULL_HANDLE;
        const VkResult result = vkAllocateDescriptorSets(context_->device, &allocation, &set);
        if (result == VK_SUCCESS) return set;
        if (fresh) LUXEL_VK(result, program.name);
        ++pool_;
    }
}

Descriptors::Place Descriptors::write_params(std::span<const std::byte> params) {
    const std::uint64_t alignment = context_->properties.limits.minUniformBufferOffsetAlignment;
    ring_offset_ = (ring_offset_ + alignment - 1) / alignment * alignment;
    if (ring_ < rings_.size() && ring_offset_ + params.size() > ring_bytes) {
        ++ring_;
        ring_offset_ = 0;
    }
    if (ring_ == rings_.size()) {
        Buffer ring;
        ring.data_ = std::make_shared<BufferData>(context_, ring_bytes, Memory::upload, "params");
        rings_.push_back(ring);
    }
    BufferStorage& storage = rings_[ring_].data_->storage;
    std::memcpy(static_cast<std::byte*>(storage.mapped) + ring_offset_, params.data(), params.size());
    const Place place{storage.buffer, ring_offset_};
    ring_offset_ += params.size();
    return place;
}

VkDescriptorSet Descriptors::make(const GpuData& gpu, const Program& program, std::uint32_t set,
                                  std::span<const std::byte> params, const Bindings& bindings) {
    if (set >= program.set_layouts.size()) {
        LUXEL_ASSERT(bindings.empty(), "{} has no set {}, so no \"{}\"", program.name, set, bindings[0].name);
        return VK_NULL_HANDLE;
    }
    std::vector<VkWriteDescriptorSet> writes;
    std::deque<VkDescriptorImageInfo> images;
    std::deque<VkDescriptorBufferInfo> buffers;
    std::deque<VkBufferView> texels;
    const VkDescriptorSet descriptor_set = allocate(program, program.set_layouts[set]);

    // Each binding of the shader, with what was given for its name.
    for (const ProgramBinding& b : program.bindings) {
        if (b.shader.set != set) continue;
        VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                   .dstSet = descriptor_set,
                                   .dstBinding = b.shader.binding,
                                   .descriptorCount = 1,
                                   .descriptorType = b.shader.type};
        if (&b == program.params) {
            const Place place = write_params(params);
            buffers.push_back({place.buffer, place.offset, params.size()});
            write.pBufferInfo = &buffers.back();
            writes.push_back(write);
            continue;
        }
        const auto given =
            std::find_if(bindings.begin(), bindings.end(), [&](const Binding& g) { return b.is(g.name); });
        const std::string_view name = b.shader.name.empty() ? b.shader.block : b.shader.name;
        LUXEL_ASSERT(given != bindings.end() || !b.shader.used, "{}: nothing is bound to \"{}\"",
                     program.name, name);
        if (given == bindings.end()) continue;

        const bool image = b.shader.view != VK_IMAGE_VIEW_TYPE_MAX_ENUM;
        LUXEL_ASSERT(std::holds_alternative<Image>(given->resource) == image, "{}: \"{}\" is {}",
                     program.name, name, image ? "an image, not a buffer" : "a buffer, not an image");
        if (image) {
            check_image(program, b, std::get<Image>(given->resource));
            write.pImageInfo = &images.emplace_back(image_info(gpu, b, *given));
        } else if (b.shader.type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER) {
            texels.push_back(
                texel_view_of(std::get<Buffer>(given->resource), texel_format(b.shader.numbers)));
            write.pTexelBufferView = &texels.back();
        } else {
            buffers.push_back(buffer_info(program, b, std::get<Buffer>(given->resource)));
            write.pBufferInfo = &buffers.back();
        }
        writes.push_back(write);
    }
    vkUpdateDescriptorSets(context_->device, std::uint32_t(writes.size()), writes.data(), 0, nullptr);
    return descriptor_set;
}

void Descriptors::reset() {
    for (VkDescriptorPool pool : pools_)
        LUXEL_VK(vkResetDescriptorPool(context_->device, pool, 0), "descriptors");
    pool_ = 0;
    ring_ = 0;
    ring_offset_ = 0;
}

} // namespace luxel::gpu
