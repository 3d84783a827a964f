// SPDX-License-Identifier: MIT
#include "gpu/verifier.h"

#include <algorithm>

#include <fmt/format.h>

namespace luxel::gpu {
namespace {

constexpr VkAccessFlags2 write_bits =
    VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_SHADER_WRITE_BIT |
    VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT |
    VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_HOST_WRITE_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;

template <class F> void for_each_bit(std::uint64_t mask, F&& f) {
    for (; mask != 0; mask &= mask - 1) f(mask & (~mask + 1));
}

// Every (stage, access) pair of the scope is among those that the write was made visible to.
bool is_visible(const VerifierState& state, const VerifierState::Scope& scope) {
    bool all = true;
    for_each_bit(scope.stages, [&](std::uint64_t stage) {
        for_each_bit(scope.access, [&](std::uint64_t access) {
            all &= std::any_of(state.visible.begin(), state.visible.end(),
                               [&](const auto& v) { return (v.stages & stage) && (v.access & access); });
        });
    });
    return all;
}

} // namespace

std::string verify_barrier(VerifierState& state, const VerifierBarrier& b) {
    std::string problem;
    const bool relayout = b.old_layout != b.new_layout;

    // Execution: whatever the source stages contain, or already waited for, now precedes the target stages.
    const bool orders_write = !state.pending || (b.source.stages & (state.write.stages | state.ordered)) != 0;
    if (state.pending && (b.source.stages & state.write.stages) && (b.source.access & state.write.access))
        state.available = true;
    const bool reads_ordered = std::all_of(state.reads.begin(), state.reads.end(), [&](const auto& read) {
        return (b.source.stages & (read.stage | read.ordered)) != 0;
    });

    // A transition reads and writes the memory, so it has to come after all that went before.
    if (relayout) {
        if (b.old_layout != VK_IMAGE_LAYOUT_UNDEFINED && b.old_layout != state.layout)
            problem = fmt::format("transition from layout {} of an image in layout {}", int(b.old_layout),
                                  int(state.layout));
        else if (!orders_write || (state.pending && !state.available))
            problem = fmt::format("layout transition races with the write of {}", state.writer);
        else if (!reads_ordered)
            problem = fmt::format("layout transition races with the read of {}", state.reader);
        state.layout = b.new_layout;
        state.pending = true;
        state.write = {};
        state.ordered = b.target.stages;
        state.available = true;
        state.visible = {b.target};
        state.reads.clear();
        state.writer = "a layout transition";
        return problem;
    }

    if (state.pending && orders_write) {
        state.ordered |= b.target.stages;
        if (state.available) state.visible.push_back(b.target);
    }
    for (auto& read : state.reads) {
        if (b.source.stages & (read.stage | read.ordered)) read.ordered |= b.target.stages;
    }
    return problem;
}

std::string verify_access(VerifierState& state, const VerifierAccess& access, std::string_view command) {
    std::string problem;
    const auto report = [&](const std::string& text) { problem += (problem.empty() ? "" : "; ") + text; };
    if (access.layout != state.layout)
        report(fmt::format("used in layout {} but is in layout {}", int(access.layout), int(state.layout)));
    if (access.reads_contents && !state.written) report("read before anything was written to it");

    // Against the last write: a memory dependency, for writes as for reads. Against reads: execution is
    // enough.
    VerifierState::Scope writes;
    for (const auto& scope : access.scopes) {
        const bool write = (scope.access & write_bits) != 0;
        if (state.pending && !is_visible(state, scope))
            report(fmt::format("{} after write: the write of {} is not visible", write ? "write" : "read",
                               state.writer));
        if (!write) continue;
        for (const auto& read : state.reads) {
            if ((scope.stages & ~read.ordered) != 0)
                report(fmt::format("write after read: does not wait for the read of {}", state.reader));
        }
        writes.stages |= scope.stages;
        writes.access |= scope.access & write_bits;
    }

    // A writing command starts the state anew; a reading one is remembered per stage.
    if (writes.stages != 0) {
        state.written = state.pending = true;
        state.write = writes;
        state.ordered = 0;
        state.available = false;
        state.visible.clear();
        state.reads.clear();
        state.writer = command;
        return problem;
    }
    state.reader = command;
    for (const auto& scope : access.scopes) {
        for_each_bit(scope.stages, [&](std::uint64_t stage) {
            std::erase_if(state.reads, [&](const auto& read) { return read.stage == stage; });
            state.reads.push_back({stage, 0});
        });
    }
    return problem;
}

} // namespace luxel::gpu
