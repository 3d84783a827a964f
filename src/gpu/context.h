// SPDX-License-Identifier: MIT
// The device and what belongs to it. Images and buffers share its ownership, so handles may outlive the Gpu.
#pragma once
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>
#include <vector>

#include "gpu/access.h"
#include "gpu/gpu.h"
#include "gpu/memory_blocks.h"
#include "gpu/verifier.h"

namespace luxel::gpu {

// Filled by the validation layer, from any thread.
struct MessageLog {
    mutable std::mutex mutex;
    std::vector<std::string> messages;
};

// An image with its memory and views; re-used for the next image of the same kind when its handles are gone.
struct ImageStorage {
    using ViewKey = std::tuple<VkImageViewType, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;

    VkImage image = VK_NULL_HANDLE;
    MemorySlice memory;
    ImageInfo info;
    VkImageUsageFlags usage = 0;
    std::uint64_t bytes = 0;
    std::map<ViewKey, VkImageView> views;
    std::vector<TrackState> state;       // [mip * layers + layer], as of the last submit
    std::vector<VerifierState> verified; // the same, for the verifier
};

struct BufferStorage {
    VkBuffer buffer = VK_NULL_HANDLE;
    MemorySlice memory;
    Memory kind = Memory::device;
    std::uint64_t capacity = 0, bytes = 0;
    void* mapped = nullptr; // upload and readback
    std::map<VkFormat, VkBufferView> texel_views;
    TrackState state;
    VerifierState verified;
};

class Context {
public:
    explicit Context(const GpuOptions& options);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    ImageStorage make_image(const ImageInfo& info, const std::string& name);
    BufferStorage make_buffer(std::uint64_t capacity, Memory kind, const std::string& name);
    // Into the pool of free ones.
    void retire(ImageStorage storage);
    void retire(BufferStorage storage);

    std::size_t allocations() const { return blocks_ ? blocks_->count() : 0; }

    void set_name(VkObjectType type, std::uint64_t handle, const std::string& name) const;

    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    std::uint32_t queue_family = 0;
    VkPhysicalDeviceProperties properties{};
    VkPhysicalDeviceMemoryProperties memory_types{};
    std::uint64_t largest_allocation = 0;
    std::uint64_t memory_limit = UINT64_MAX; // tests pretend to have a smaller device
    DeviceInfo info;
    std::shared_ptr<MessageLog> log = std::make_shared<MessageLog>();
    MemoryUse memory;

    PFN_vkCmdBeginDebugUtilsLabelEXT begin_label = nullptr; // null without VK_EXT_debug_utils
    PFN_vkCmdEndDebugUtilsLabelEXT end_label = nullptr;

private:
    void make_instance(const GpuOptions& options);
    void make_device();
    void check_size(std::uint64_t bytes, const std::string& name) const;
    std::optional<MemorySlice> try_allocate(const MemoryWish& wish);
    MemorySlice allocate(const VkMemoryRequirements& needs, Memory kind, bool linear,
                         const std::string& name);
    void destroy(ImageStorage& storage);
    void destroy(BufferStorage& storage);
    void trim(std::uint64_t limit);
    void count(std::uint64_t bytes);

    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    PFN_vkSetDebugUtilsObjectNameEXT set_object_name_ = nullptr;
    std::list<ImageStorage> free_images_; // oldest first
    std::list<BufferStorage> free_buffers_;
    std::uint64_t free_bytes_ = 0;
    std::optional<MemoryBlocks> blocks_; // from make_device() on
};

struct ImageData {
    std::shared_ptr<Context> context;
    ImageStorage storage;
    std::string name;

    ImageData(std::shared_ptr<Context> c, const ImageInfo& info, std::string image_name);
    ~ImageData();
    ImageData(const ImageData&) = delete;
    ImageData& operator=(const ImageData&) = delete;
};

struct BufferData {
    std::shared_ptr<Context> context;
    BufferStorage storage;
    std::uint64_t size = 0; // capacity may be more
    std::string name;

    BufferData(std::shared_ptr<Context> c, std::uint64_t bytes, Memory kind, std::string buffer_name);
    ~BufferData();
    BufferData(const BufferData&) = delete;
    BufferData& operator=(const BufferData&) = delete;
};

// The selected part of an image, with the counts resolved.
struct Range {
    std::uint32_t first_mip = 0, mips = 1, first_layer = 0, layers = 1;
};
Range range_of(const Image& image);
VkImageAspectFlags aspect_of(VkFormat format);
VkImageLayout sampled_layout(VkFormat format);
VkImageView view_of(const Image& image, VkImageViewType type);
VkBufferView texel_view_of(const Buffer& buffer, VkFormat format);
bool validation_available();

} // namespace luxel::gpu
