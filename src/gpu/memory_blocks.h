// SPDX-License-Identifier: MIT
// Device memory in blocks that resources share. Common drivers allow 4096 allocations in all, and a frame
// with many captures has more images than that.
#pragma once
#include <cstdint>
#include <list>
#include <map>
#include <optional>

#include <vulkan/vulkan.h>

namespace luxel::gpu {

struct MemoryBlock; // internal

// A part of a block, or a whole one.
struct MemorySlice {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::uint64_t offset = 0;
    void* mapped = nullptr; // of the slice, where it was asked for
    MemoryBlock* block = nullptr;
};

struct MemoryWish {
    std::uint32_t type = 0; // of the device's memory types
    bool linear =
        false; // buffers; they never share a block with images, whose neighbors must keep a distance
    bool mapped = false;
    std::uint64_t size = 0, alignment = 1; // bytes; alignment is a power of two
};

class MemoryBlocks {
public:
    // block_bytes: what is allocated at once for requests of up to a quarter of it; larger ones get blocks of
    // their own.
    explicit MemoryBlocks(VkDevice device = VK_NULL_HANDLE, std::uint64_t block_bytes = std::uint64_t(64)
                                                                                        << 20);
    ~MemoryBlocks();
    MemoryBlocks(const MemoryBlocks&) = delete;
    MemoryBlocks& operator=(const MemoryBlocks&) = delete;

    // Nothing where the driver has no more.
    std::optional<MemorySlice> allocate(const MemoryWish& wish);
    void free(const MemorySlice& slice); // no slice: nothing

    std::size_t count() const { return blocks_.size(); } // allocations that the driver sees

private:
    MemoryBlock* add_block(const MemoryWish& wish, std::uint64_t bytes);

    VkDevice device_;
    std::uint64_t block_bytes_;
    std::list<MemoryBlock> blocks_;
};

// Free and used parts of `bytes` bytes, by offset; first fit. Apart, so that it can be tested without a
// device.
class FreeList {
public:
    explicit FreeList(std::uint64_t bytes);
    std::optional<std::uint64_t> take(std::uint64_t size, std::uint64_t alignment); // offset
    void give_back(std::uint64_t offset); // of a part that was taken
    bool unused() const { return used_.empty(); }

private:
    std::map<std::uint64_t, std::uint64_t> free_, used_; // offset: size
};

struct MemoryBlock {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    void* mapped = nullptr;
    std::uint32_t type = 0;
    bool linear = false;
    FreeList parts;
};

} // namespace luxel::gpu
