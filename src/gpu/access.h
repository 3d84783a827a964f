// SPDX-License-Identifier: MIT
// How commands use images and buffers: the vocabulary of the tracker, and the barriers that follow from it.
#pragma once
#include <cstdint>
#include <optional>

#include <vulkan/vulkan.h>

namespace luxel::gpu {

// A set of uses, one bit each; every bit is one (stage, access) pair, so that "visible to" is a set as well.
using Uses = std::uint32_t;
namespace use {
// The four shader uses, to be shifted by the stage: in(compute, sampled).
inline constexpr Uses sampled = 1, uniform = 2, storage_read = 4, storage_write = 8;
inline constexpr int compute = 0, vertex = 4, fragment = 8;
constexpr Uses in(int stage, Uses shader_uses) { return shader_uses << stage; }

inline constexpr Uses color = 1u << 12; // attachment, loaded or blended and stored
inline constexpr Uses depth_write = 1u << 13, depth_read = 1u << 14;
inline constexpr Uses transfer_read = 1u << 15, transfer_write = 1u << 16;
inline constexpr Uses indirect = 1u << 17, index = 1u << 18, host_read = 1u << 19;
inline constexpr int count = 20;

inline constexpr Uses writing = in(compute, storage_write) | in(vertex, storage_write) |
                                in(fragment, storage_write) | color | depth_write | transfer_write;
} // namespace use

struct StageAccess {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 access = 0;
};
StageAccess stage_access(Uses uses);
// Only what writes: the source half of a barrier's access.
VkAccessFlags2 write_access(Uses uses);

// What has happened to a buffer or to one mip and layer of an image. A layout transition counts as a write.
struct TrackState {
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED; // stays undefined for buffers
    Uses last = 0;    // the uses that the last write had, or that the last transition was for
    Uses visible = 0; // uses to which that write is visible
    Uses reads = 0;   // uses since that write
};

struct Transition {
    Uses from, to;
    VkImageLayout old_layout, new_layout;
    bool operator==(const Transition&) const = default;
};

// Makes the state that of after the uses; returns the dependency needed before them.
std::optional<Transition> advance(TrackState& state, Uses uses, VkImageLayout layout);

} // namespace luxel::gpu
