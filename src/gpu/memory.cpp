// SPDX-License-Identifier: MIT
// Images and buffers with their memory. Frames make the same images again and again, so those that nobody
// holds any more are kept for the next request of the same kind.
#include <algorithm>
#include <bit>

#include "gpu/check.h"
#include "gpu/context.h"
#include "gpu/format.h"

namespace luxel::gpu {
namespace {

// Every use that the format can have, so that one image serves any pass.
VkImageUsageFlags usage_of(VkPhysicalDevice physical, VkFormat format) {
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(physical, format, &properties);
    const VkFormatFeatureFlags can = properties.optimalTilingFeatures;
    VkImageUsageFlags usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if (can & VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT) usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
    if (can & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) usage |= VK_IMAGE_USAGE_STORAGE_BIT;
    if (can & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT) usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (can & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT)
        usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    return usage;
}

bool same(const ImageInfo& a, const ImageInfo& b) {
    return a.width == b.width && a.height == b.height && a.format == b.format && a.mips == b.mips &&
           a.layers == b.layers && a.cube == b.cube;
}

} // namespace

void Context::check_size(std::uint64_t bytes, const std::string& name) const {
    if (bytes > largest_allocation)
        fail(Fault::resource, "gpu: {}: {} MiB, but {} allows {} MiB in one piece", name, bytes >> 20,
             info.name, largest_allocation >> 20);
}

std::optional<MemorySlice> Context::try_allocate(const MemoryWish& wish) {
    if (memory.now + free_bytes_ + wish.size > memory_limit) return std::nullopt;
    return blocks_->allocate(wish);
}

MemorySlice Context::allocate(const VkMemoryRequirements& needs, Memory kind, bool linear,
                              const std::string& name) {
    check_size(needs.size, name);

    // Preferences in order; the last one always exists by the specification.
    constexpr VkMemoryPropertyFlags host =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    std::vector<VkMemoryPropertyFlags> wishes;
    if (kind == Memory::device) wishes = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
    if (kind == Memory::upload) wishes = {host};
    if (kind == Memory::readback) wishes = {host | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, host};

    for (const VkMemoryPropertyFlags wish : wishes) {
        for (std::uint32_t type = 0; type < memory_types.memoryTypeCount; ++type) {
            const bool fits = (needs.memoryTypeBits >> type & 1u) != 0 &&
                              (memory_types.memoryTypes[type].propertyFlags & wish) == wish;
            if (!fits) continue;
            const MemoryWish request{.type = type,
                                     .linear = linear,
                                     .mapped = kind != Memory::device,
                                     .size = needs.size,
                                     .alignment = needs.alignment};
            if (const auto slice = try_allocate(request)) return *slice;

            // The free ones may be what is in the way.
            trim(0);
            if (const auto slice = try_allocate(request)) return *slice;
        }
    }
    fail(Fault::resource, "gpu: {}: {} MiB of device memory cannot be had ({} MiB are in use)", name,
         (needs.size + (1u << 20) - 1) >> 20, memory.now >> 20);
}

void Context::count(std::uint64_t bytes) {
    memory.now += bytes;
    memory.peak = std::max(memory.peak, memory.now);
}

ImageStorage Context::make_image(const ImageInfo& wanted, const std::string& name) {
    // A free one of the same kind: its contents are gone, its past uses still count.
    const auto free = std::find_if(free_images_.begin(), free_images_.end(),
                                   [&](const ImageStorage& s) { return same(s.info, wanted); });
    if (free != free_images_.end()) {
        ImageStorage storage = std::move(*free);
        free_images_.erase(free);
        free_bytes_ -= storage.bytes;
        for (TrackState& s : storage.state) s.layout = VK_IMAGE_LAYOUT_UNDEFINED;
        for (VerifierState& s : storage.verified) s.written = false;
        count(storage.bytes);
        return storage;
    }

    const std::uint32_t most_layers = properties.limits.maxImageArrayLayers;
    if (wanted.layers > most_layers)
        fail(Fault::resource, "gpu: {}: {} layers, but {} allows {}", name, wanted.layers, info.name,
             most_layers);
    const std::uint32_t largest = properties.limits.maxImageDimension2D;
    if (wanted.width > largest || wanted.height > largest)
        fail(Fault::resource, "gpu: {}: {}x{} pixels, but {} allows {} a side", name, wanted.width,
             wanted.height, info.name, largest);
    LUXEL_ASSERT(wanted.width > 0 && wanted.height > 0 && wanted.mips > 0 && wanted.layers > 0,
                 "image {} of {}x{}, {} mips, {} layers", name, wanted.width, wanted.height, wanted.mips,
                 wanted.layers);
    LUXEL_ASSERT(!wanted.cube || (wanted.layers % 6 == 0 && wanted.width == wanted.height),
                 "cube {} of {}x{}, {} layers", name, wanted.width, wanted.height, wanted.layers);

    ImageStorage storage{.info = wanted, .usage = usage_of(physical, format_info(wanted.format).format)};
    const VkImageCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .flags = wanted.cube ? VkImageCreateFlags(VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT) : 0u,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = wanted.format,
        .extent = {wanted.width, wanted.height, 1},
        .mipLevels = wanted.mips,
        .arrayLayers = wanted.layers,
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .usage = storage.usage};
    LUXEL_VK(vkCreateImage(device, &create, nullptr, &storage.image), name);
    VkMemoryRequirements needs{};
    vkGetImageMemoryRequirements(device, storage.image, &needs);
    try {
        storage.memory = allocate(needs, Memory::device, false, name);
        LUXEL_VK(vkBindImageMemory(device, storage.image, storage.memory.memory, storage.memory.offset),
                 name);
    } catch (...) {
        destroy(storage);
        throw;
    }
    storage.bytes = needs.size;
    storage.state.resize(std::size_t(wanted.mips) * wanted.layers);
    storage.verified.resize(storage.state.size());
    count(storage.bytes);
    return storage;
}

BufferStorage Context::make_buffer(std::uint64_t capacity, Memory kind, const std::string& name) {
    const auto free = std::find_if(free_buffers_.begin(), free_buffers_.end(), [&](const BufferStorage& s) {
        return s.capacity == capacity && s.kind == kind;
    });
    if (free != free_buffers_.end()) {
        BufferStorage storage = std::move(*free);
        free_buffers_.erase(free);
        free_bytes_ -= storage.bytes;
        storage.verified.written = false;
        count(storage.bytes);
        return storage;
    }

    check_size(capacity, name);
    BufferStorage storage{.kind = kind, .capacity = capacity};
    const VkBufferCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = capacity,
        .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
                 VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
                 VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                 VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    LUXEL_VK(vkCreateBuffer(device, &create, nullptr, &storage.buffer), name);
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device, storage.buffer, &needs);
    try {
        storage.memory = allocate(needs, kind, true, name);
        LUXEL_VK(vkBindBufferMemory(device, storage.buffer, storage.memory.memory, storage.memory.offset),
                 name);
        storage.mapped = storage.memory.mapped;
    } catch (...) {
        destroy(storage);
        throw;
    }
    storage.bytes = needs.size;
    count(storage.bytes);
    return storage;
}

void Context::retire(ImageStorage storage) {
    memory.now -= storage.bytes;
    free_bytes_ += storage.bytes;
    free_images_.push_back(std::move(storage));
    trim(info.memory_bytes / 4); // a scene's worth stays free for other programs
}

void Context::retire(BufferStorage storage) {
    memory.now -= storage.bytes;
    free_bytes_ += storage.bytes;
    free_buffers_.push_back(std::move(storage));
    trim(info.memory_bytes / 4);
}

void Context::trim(std::uint64_t limit) {
    while (free_bytes_ > limit && !free_buffers_.empty()) {
        free_bytes_ -= free_buffers_.front().bytes;
        destroy(free_buffers_.front());
        free_buffers_.pop_front();
    }
    while (free_bytes_ > limit && !free_images_.empty()) {
        free_bytes_ -= free_images_.front().bytes;
        destroy(free_images_.front());
        free_images_.pop_front();
    }
}

void Context::destroy(ImageStorage& storage) {
    for (const auto& [key, view] : storage.views) vkDestroyImageView(device, view, nullptr);
    vkDestroyImage(device, storage.image, nullptr);
    blocks_->free(storage.memory);
}

void Context::destroy(BufferStorage& storage) {
    for (const auto& [format, view] : storage.texel_views) vkDestroyBufferView(device, view, nullptr);
    vkDestroyBuffer(device, storage.buffer, nullptr);
    blocks_->free(storage.memory);
}

ImageData::ImageData(std::shared_ptr<Context> c, const ImageInfo& info, std::string image_name)
    : context(std::move(c)), storage(context->make_image(info, image_name)), name(std::move(image_name)) {
    context->set_name(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<std::uint64_t>(storage.image), name);
}

ImageData::~ImageData() { context->retire(std::move(storage)); }

// Staging comes in all sizes: powers of two make them fit again.
BufferData::BufferData(std::shared_ptr<Context> c, std::uint64_t bytes, Memory kind, std::string buffer_name)
    : context(std::move(c)), size(bytes), name(std::move(buffer_name)) {
    const std::uint64_t least = std::max<std::uint64_t>(bytes, 16); // an empty buffer can be bound, too
    storage = context->make_buffer(kind == Memory::device ? (least + 15) / 16 * 16 : std::bit_ceil(least),
                                   kind, name);
    context->set_name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(storage.buffer), name);
}

BufferData::~BufferData() { context->retire(std::move(storage)); }

} // namespace luxel::gpu
