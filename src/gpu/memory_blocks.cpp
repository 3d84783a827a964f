// SPDX-License-Identifier: MIT
#include "gpu/memory_blocks.h"

#include <algorithm>

#include "core/error.h"

namespace luxel::gpu {

FreeList::FreeList(std::uint64_t bytes) { free_.emplace(0, bytes); }

std::optional<std::uint64_t> FreeList::take(std::uint64_t size, std::uint64_t alignment) {
    for (auto part = free_.begin(); part != free_.end(); ++part) {
        const auto [start, bytes] = *part;
        const std::uint64_t offset = (start + alignment - 1) & ~(alignment - 1);
        if (offset - start > bytes || bytes - (offset - start) < size) continue;
        free_.erase(part);
        if (offset > start) free_.emplace(start, offset - start);
        const std::uint64_t end = start + bytes;
        if (end > offset + size) free_.emplace(offset + size, end - offset - size);
        used_.emplace(offset, size);
        return offset;
    }
    return std::nullopt;
}

void FreeList::give_back(std::uint64_t offset) {
    const auto part = used_.find(offset);
    LUXEL_ASSERT(part != used_.end(), "offset={}", offset);
    std::uint64_t start = offset, end = offset + part->second;
    used_.erase(part);

    // Free neighbors become one part.
    const auto after = free_.find(end);
    if (after != free_.end()) {
        end += after->second;
        free_.erase(after);
    }
    const auto next = free_.lower_bound(start);
    if (next != free_.begin()) {
        const auto before = std::prev(next);
        if (before->first + before->second == start) {
            start = before->first;
            free_.erase(before);
        }
    }
    free_.emplace(start, end - start);
}

MemoryBlocks::MemoryBlocks(VkDevice device, std::uint64_t block_bytes)
    : device_(device), block_bytes_(block_bytes) {}

MemoryBlocks::~MemoryBlocks() {
    for (const MemoryBlock& block : blocks_) vkFreeMemory(device_, block.memory, nullptr);
}

MemoryBlock* MemoryBlocks::add_block(const MemoryWish& wish, std::uint64_t bytes) {
    const VkMemoryAllocateInfo allocation{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                          .allocationSize = bytes,
                                          .memoryTypeIndex = wish.type};
    MemoryBlock block{.type = wish.type, .linear = wish.linear, .parts = FreeList(bytes)};
    if (vkAllocateMemory(device_, &allocation, nullptr, &block.memory) != VK_SUCCESS) return nullptr;
    if (wish.mapped && vkMapMemory(device_, block.memory, 0, VK_WHOLE_SIZE, 0, &block.mapped) != VK_SUCCESS) {
        vkFreeMemory(device_, block.memory, nullptr);
        return nullptr;
    }
    return &blocks_.emplace_back(std::move(block));
}

std::optional<MemorySlice> MemoryBlocks::allocate(const MemoryWish& wish) {
    const auto slice_of = [&](MemoryBlock& block) -> std::optional<MemorySlice> {
        const auto offset = block.parts.take(wish.size, wish.alignment);
        if (!offset) return std::nullopt;
        return MemorySlice{.memory = block.memory,
                           .offset = *offset,
                           .mapped = block.mapped ? static_cast<std::byte*>(block.mapped) + *offset : nullptr,
                           .block = &block};
    };

    // Large requests have a block of their own; a small one takes the first block with room.
    const bool alone = wish.size > block_bytes_ / 4;
    if (!alone)
        for (MemoryBlock& block : blocks_) {
            const bool alike = block.type == wish.type && block.linear == wish.linear &&
                               (block.mapped != nullptr) == wish.mapped;
            if (!alike) continue;
            if (const auto slice = slice_of(block)) return slice;
        }
    MemoryBlock* block = add_block(wish, alone ? wish.size : block_bytes_);
    // Where there is no room for a block there may be some for the request itself.
    if (!block && !alone) block = add_block(wish, wish.size);
    return block ? slice_of(*block) : std::nullopt;
}

void MemoryBlocks::free(const MemorySlice& slice) {
    if (!slice.block) return;
    slice.block->parts.give_back(slice.offset);
    if (!slice.block->parts.unused()) return;
    vkFreeMemory(device_, slice.memory, nullptr);
    blocks_.remove_if([&](const MemoryBlock& block) { return &block == slice.block; });
}

} // namespace luxel::gpu
