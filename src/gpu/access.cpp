// SPDX-License-Identifier: MIT
#include "gpu/access.h"

#include <array>

namespace luxel::gpu {
namespace {

constexpr StageAccess shader_use(VkPipelineStageFlags2 stage, int i) {
    constexpr VkAccessFlags2 access[4] = {
        VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
        VK_ACCESS_2_UNIFORM_READ_BIT,
        VK_ACCESS_2_SHADER_STORAGE_READ_BIT,
        VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
    };
    return {stage, access[i]};
}

constexpr std::array<StageAccess, use::count> make_table() {
    constexpr auto tests =
        VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
    std::array<StageAccess, use::count> t{};
    for (int i = 0; i < 4; ++i) {
        t[std::size_t(use::compute + i)] = shader_use(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, i);
        t[std::size_t(use::vertex + i)] = shader_use(VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, i);
        t[std::size_t(use::fragment + i)] = shader_use(VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, i);
    }
    t[12] = {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
             VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
    t[13] = {tests,
             VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
    t[14] = {tests, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT};
    t[15] = {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
    t[16] = {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
    t[17] = {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT};
    t[18] = {VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT};
    t[19] = {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};
    return t;
}

constexpr std::array<StageAccess, use::count> table = make_table();

} // namespace

StageAccess stage_access(Uses uses) {
    StageAccess sum;
    for (int i = 0; i < use::count; ++i) {
        if ((uses >> i & 1u) == 0) continue;
        sum.stages |= table[std::size_t(i)].stages;
        sum.access |= table[std::size_t(i)].access;
    }
    return sum;
}

VkAccessFlags2 write_access(Uses uses) {
    constexpr VkAccessFlags2 writes =
        VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
        VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;
    return stage_access(uses).access & writes;
}

std::optional<Transition> advance(TrackState& state, Uses uses, VkImageLayout layout) {
    const bool writes = (uses & use::writing) != 0;
    const bool relayout = layout != state.layout;

    // Writes and transitions wait for everything before them, the same access included.
    if (writes || relayout) {
        const Transition t{state.last | state.reads, uses, state.layout, layout};
        state = {layout, uses, writes ? 0 : uses, writes ? 0 : uses};
        if (relayout || t.from != 0) return t;
        return std::nullopt;
    }

    // Reads wait for the last write, unless it is visible to them already.
    const Uses missing = uses & ~state.visible;
    state.visible |= uses;
    state.reads |= uses;
    if (missing == 0 || state.last == 0) return std::nullopt;
    return Transition{state.last, missing, layout, layout};
}

} // namespace luxel::gpu
