// SPDX-License-Identifier: MIT
// The second opinion on hazards. It knows nothing of how the tracker decides: at submit it replays what was
// recorded, raw barriers and raw accesses in the order of execution, against the rules of the Vulkan memory
// model.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <vulkan/vulkan.h>

namespace luxel::gpu {

// One buffer, or one mip and layer of one image.
struct VerifierState {
    struct Scope {
        VkPipelineStageFlags2 stages = 0;
        VkAccessFlags2 access = 0;
    };
    struct Read {
        VkPipelineStageFlags2 stage = 0;   // one bit
        VkPipelineStageFlags2 ordered = 0; // stages that wait for it
    };

    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    bool written = false;              // since the resource was made
    bool pending = false;              // there is a last write to be ordered against
    Scope write;                       // the last write; no stages for a layout transition
    VkPipelineStageFlags2 ordered = 0; // stages that wait for it
    bool available = false;            // its data has left the writer's caches
    std::vector<Scope> visible;        // where its data can be seen
    std::vector<Read> reads;           // since it
    std::string writer;                // names for messages
    std::string reader;
};

struct VerifierBarrier {
    VerifierState::Scope source, target;
    VkImageLayout old_layout, new_layout;
};

struct VerifierAccess {
    std::vector<VerifierState::Scope> scopes; // what one command does to the resource
    VkImageLayout layout;
    bool reads_contents = true; // false: whatever was there is overwritten or not needed
};

// Each returns "" or what is wrong ("read after write: not visible to ..."); the state goes on as if all were
// well.
std::string verify_barrier(VerifierState& state, const VerifierBarrier& barrier);
std::string verify_access(VerifierState& state, const VerifierAccess& access, std::string_view command);

} // namespace luxel::gpu
