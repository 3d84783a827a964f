// SPDX-License-Identifier: MIT
#include "gpu/commands.h"

#include <algorithm>
#include <limits>

#include "gpu/check.h"

namespace luxel::gpu {
namespace {

constexpr std::uint32_t queries_per_pool = 256;

bool can_extend(const VkImageMemoryBarrier2& a, const VkImageMemoryBarrier2& b) {
    return a.image == b.image && a.srcStageMask == b.srcStageMask && a.srcAccessMask == b.srcAccessMask &&
           a.dstStageMask == b.dstStageMask && a.dstAccessMask == b.dstAccessMask &&
           a.oldLayout == b.oldLayout && a.newLayout == b.newLayout;
}

// Neighboring layers first, then mips with the same layers.
void append(std::vector<VkImageMemoryBarrier2>& list, const VkImageMemoryBarrier2& b) {
    if (!list.empty() && can_extend(list.back(), b)) {
        VkImageSubresourceRange& last = list.back().subresourceRange;
        const VkImageSubresourceRange& next = b.subresourceRange;
        if (last.levelCount == 1 && last.baseMipLevel == next.baseMipLevel &&
            last.baseArrayLayer + last.layerCount == next.baseArrayLayer) {
            ++last.layerCount;
            if (list.size() < 2 || !can_extend(list[list.size() - 2], b)) return;
            VkImageSubresourceRange& before = list[list.size() - 2].subresourceRange;
            if (before.baseArrayLayer == last.baseArrayLayer && before.layerCount == last.layerCount &&
                before.baseMipLevel + before.levelCount == last.baseMipLevel) {
                ++before.levelCount;
                list.pop_back();
            }
            return;
        }
        if (last.layerCount == 1 && last.baseArrayLayer == next.baseArrayLayer &&
            last.baseMipLevel + last.levelCount == next.baseMipLevel) {
            ++last.levelCount;
            return;
        }
    }
    list.push_back(b);
}

} // namespace

Commands::Commands(GpuData& gpu) : gpu_(gpu) {
    const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                       .queueFamilyIndex = context().queue_family};
    LUXEL_VK(vkCreateCommandPool(context().device, &pool, nullptr, &pool_), "recorder");
    VkCommandBuffer buffers[2];
    const VkCommandBufferAllocateInfo allocation{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                 .commandPool = pool_,
                                                 .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                 .commandBufferCount = 2};
    LUXEL_VK(vkAllocateCommandBuffers(context().device, &allocation, buffers), "recorder");
    preamble_ = buffers[0];
    body_ = buffers[1];
    const VkFenceCreateInfo fence{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    LUXEL_VK(vkCreateFence(context().device, &fence, nullptr, &fence_), "recorder");
}

Commands::~Commands() {
    if (gpu_.faults.skip_wait) vkDeviceWaitIdle(context().device);
    for (VkQueryPool pool : queries_) vkDestroyQueryPool(context().device, pool, nullptr);
    vkDestroyFence(context().device, fence_, nullptr);
    vkDestroyCommandPool(context().device, pool_, nullptr);
}

Commands::Resource& Commands::resource_of(const Image& image) {
    LUXEL_ASSERT(image, "an empty image is used");
    const auto [found, fresh] = index_.try_emplace(image.data_.get(), resources_.size());
    if (fresh) {
        resources_.push_back({.image = image.data_});
        resources_.back().subs.resize(image.data_->storage.state.size());
    }
    return resources_[found->second];
}

Commands::Resource& Commands::resource_of(const Buffer& buffer) {
    LUXEL_ASSERT(buffer, "an empty buffer is used");
    const auto [found, fresh] = index_.try_emplace(buffer.data_.get(), resources_.size());
    if (fresh) {
        resources_.push_back({.buffer_data = buffer.data_});
        resources_.back().subs.resize(1);
    }
    return resources_[found->second];
}

void Commands::use(const Image& image, Uses uses, VkImageLayout layout, bool reads_contents) {
    if (uses == 0) return;
    Resource& resource = resource_of(image);
    const Range range = range_of(image);
    for (std::uint32_t mip = range.first_mip; mip < range.first_mip + range.mips; ++mip) {
        for (std::uint32_t layer = range.first_layer; layer < range.first_layer + range.layers; ++layer) {
            Sub& sub = resource.subs[std::size_t(mip) * image.info().layers + layer];
            LUXEL_ASSERT(sub.pending == 0 || sub.pending_layout == layout,
                         "image {}, mip {}, layer {} is used in two ways by one pass (layouts {} and {})",
                         image.name(), mip, layer, int(sub.pending_layout), int(layout));
            sub.pending |= uses;
            sub.pending_layout = layout;
            sub.pending_reads |= reads_contents;
        }
    }
    if (!resource.touched) touched_.push_back(std::size_t(&resource - resources_.data()));
    resource.touched = true;
}

void Commands::use(const Buffer& buffer, Uses uses, bool reads_contents) {
    if (uses == 0) return;
    Resource& resource = resource_of(buffer);
    resource.subs[0].pending |= uses;
    resource.subs[0].pending_reads |= reads_contents;
    if (!resource.touched) touched_.push_back(std::size_t(&resource - resources_.data()));
    resource.touched = true;
}

void Commands::start() {
    if (started_) return;
    const VkCommandBufferBeginInfo begin_info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                              .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    LUXEL_VK(vkBeginCommandBuffer(preamble_, &begin_info), "recorder");
    LUXEL_VK(vkBeginCommandBuffer(body_, &begin_info), "recorder");
    started_ = true;
    stamp(preamble_);
}

// One more of the submit's timestamps.
void Commands::stamp(VkCommandBuffer target) {
    const std::uint32_t pool = stamps_ / queries_per_pool, query = stamps_ % queries_per_pool;
    ++stamps_;
    if (pool >= queries_.size()) {
        const VkQueryPoolCreateInfo create{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                           .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                           .queryCount = queries_per_pool};
        queries_.push_back(VK_NULL_HANDLE);
        LUXEL_VK(vkCreateQueryPool(context().device, &create, nullptr, &queries_.back()), "timestamps");
    }
    if (query == 0) vkCmdResetQueryPool(target, queries_[pool], 0, queries_per_pool);
    vkCmdWriteTimestamp2(target, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_[pool], query);
}

void Commands::add_barrier(std::size_t resource, std::size_t index, const Transition& t, Barriers& barriers,
                           std::vector<Event>& events) {
    const Resource& r = resources_[resource];
    const StageAccess from = stage_access(t.from), to = stage_access(t.to);
    const VkAccessFlags2 flushed = write_access(t.from);
    events.push_back(
        {resource, index, passes_.back(),
         VerifierBarrier{{from.stages, flushed}, {to.stages, to.access}, t.old_layout, t.new_layout}});
    if (r.buffer_data) {
        barriers.buffers.push_back({.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2,
                                    .srcStageMask = from.stages,
                                    .srcAccessMask = flushed,
                                    .dstStageMask = to.stages,
                                    .dstAccessMask = to.access,
                                    .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                    .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                    .buffer = r.buffer_data->storage.buffer,
                                    .size = VK_WHOLE_SIZE});
        return;
    }
    const ImageInfo& info = r.image->storage.info;
    append(barriers.images, {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                             .srcStageMask = from.stages,
                             .srcAccessMask = flushed,
                             .dstStageMask = to.stages,
                             .dstAccessMask = to.access,
                             .oldLayout = t.old_layout,
                             .newLayout = t.new_layout,
                             .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                             .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                             .image = r.image->storage.image,
                             .subresourceRange = {aspect_of(info.format), std::uint32_t(index / info.layers),
                                                  1, std::uint32_t(index % info.layers), 1}});
}

// The pending uses of one subresource: what they need before them, and the verifier's record.
void Commands::require(Sub& sub, std::size_t resource, std::size_t index, Barriers& barriers) {
    const bool writes = (sub.pending & use::writing) != 0;
    if (!sub.seen) {
        sub.seen = true;
        sub.initial = !writes;
        sub.first_uses = sub.pending;
        sub.first_layout = sub.pending_layout;
        sub.state = {sub.pending_layout, sub.pending, writes ? 0 : sub.pending, writes ? 0 : sub.pending};
    } else if (sub.initial && !writes && sub.pending_layout == sub.first_layout) {
        sub.first_uses |= sub.pending;
        sub.state = {sub.first_layout, sub.first_uses, sub.first_uses, sub.first_uses};
    } else {
        sub.initial = false;
        const auto t = advance(sub.state, sub.pending, sub.pending_layout);
        if (t && !(gpu_.faults.skip_barriers && t->old_layout == t->new_layout))
            add_barrier(resource, index, *t, barriers, events_);
    }
}

void Commands::begin(const std::string& name) {
    start();
    std::string prefix;
    for (const std::string& scope : scopes_) prefix += scope + ": ";
    const std::string& label = passes_.emplace_back(prefix + name); // a deque: it stays where it is

    // Barriers, then the accesses that they allow.
    Barriers barriers;
    for (const std::size_t i : touched_) {
        Resource& r = resources_[i];
        for (std::size_t s = 0; s < r.subs.size(); ++s) {
            Sub& sub = r.subs[s];
            if (sub.pending == 0) continue;
            require(sub, i, s, barriers);
            VerifierAccess access{.layout = sub.pending_layout, .reads_contents = sub.pending_reads};
            for (int bit = 0; bit < use::count; ++bit) {
                if ((sub.pending >> bit & 1u) == 0) continue;
                const StageAccess scope = stage_access(Uses(1) << bit);
                access.scopes.push_back({scope.stages, scope.access});
            }
            events_.push_back({i, s, label, std::move(access)});
            sub.pending = 0;
            sub.pending_reads = false;
        }
        r.touched = false;
    }
    touched_.clear();
    record(body_, barriers);

    if (context().begin_label) {
        const VkDebugUtilsLabelEXT text{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT,
                                        .pLabelName = label.c_str()};
        context().begin_label(body_, &text);
    }
}

void Commands::end() {
    if (context().end_label) context().end_label(body_);
    stamp(body_);
}

void Commands::push_scope(std::string name) { scopes_.push_back(std::move(name)); }
void Commands::pop_scope() { scopes_.pop_back(); }

void Commands::record(VkCommandBuffer target, const Barriers& barriers) const {
    if (barriers.images.empty() && barriers.buffers.empty()) return;
    const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                      .bufferMemoryBarrierCount = std::uint32_t(barriers.buffers.size()),
                                      .pBufferMemoryBarriers = barriers.buffers.data(),
                                      .imageMemoryBarrierCount = std::uint32_t(barriers.images.size()),
                                      .pImageMemoryBarriers = barriers.images.data()};
    vkCmdPipelineBarrier2(target, &dependency);
}

// What the CPU is going to look at.
void Commands::use_on_host() {
    Barriers barriers;
    for (std::size_t i = 0; i < resources_.size(); ++i) {
        const Resource& r = resources_[i];
        if (!r.buffer_data || r.buffer_data->storage.kind != Memory::readback) continue;
        TrackState& state = resources_[i].subs[0].state;
        if ((state.last & use::writing) == 0) continue;
        if (const auto t = advance(state, use::host_read, VK_IMAGE_LAYOUT_UNDEFINED))
            add_barrier(i, 0, *t, barriers, events_);
        const StageAccess host = stage_access(use::host_read);
        events_.push_back(
            {i, 0, "host", VerifierAccess{{{host.stages, host.access}}, VK_IMAGE_LAYOUT_UNDEFINED}});
    }
    record(body_, barriers);
}

// Meets the first requirements from the state that earlier submits left, and leaves ours.
void Commands::enter_global_state(std::vector<Event>& events) {
    Barriers barriers;
    for (std::size_t i = 0; i < resources_.size(); ++i) {
        Resource& r = resources_[i];
        for (std::size_t s = 0; s < r.subs.size(); ++s) {
            Sub& sub = r.subs[s];
            if (!sub.seen) continue;
            TrackState& global = r.image ? r.image->storage.state[s] : r.buffer_data->storage.state;
            const auto t = advance(global, sub.first_uses, sub.first_layout);
            if (t && !(gpu_.faults.skip_entry && t->old_layout == t->new_layout))
                add_barrier(i, s, *t, barriers, events);
            if (!sub.initial) global = sub.state;
        }
    }
    record(preamble_, barriers);
}

void Commands::verify(const std::vector<Event>& events) {
    for (const Event& e : events) {
        Resource& r = resources_[e.resource];
        VerifierState& state = r.image ? r.image->storage.verified[e.sub] : r.buffer_data->storage.verified;
        const std::string problem = std::holds_alternative<VerifierBarrier>(e.what)
                                        ? verify_barrier(state, std::get<VerifierBarrier>(e.what))
                                        : verify_access(state, std::get<VerifierAccess>(e.what), e.command);
        if (problem.empty()) continue;
        LUXEL_ASSERT(gpu_.faults.keep_hazards, "{}: {} (part {}): {}", e.command, r.name(), e.sub, problem);
        gpu_.hazards.push_back(fmt::format("{}: {} (part {}): {}", e.command, r.name(), e.sub, problem));
    }
}

std::vector<PassTime> Commands::submit() {
    if (!started_) return {};
    use_on_host();
    std::vector<Event> events;
    enter_global_state(events);
    events.insert(events.end(), std::make_move_iterator(events_.begin()),
                  std::make_move_iterator(events_.end()));
    verify(events);
    LUXEL_VK(vkEndCommandBuffer(preamble_), "recorder");
    LUXEL_VK(vkEndCommandBuffer(body_), "recorder");

    const VkCommandBufferSubmitInfo buffers[] = {
        {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, .commandBuffer = preamble_},
        {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, .commandBuffer = body_}};
    const VkSubmitInfo2 info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                             .commandBufferInfoCount = 2,
                             .pCommandBufferInfos = buffers};
    LUXEL_VK(vkQueueSubmit2(context().queue, 1, &info, fence_), "recorder");
    if (gpu_.faults.skip_wait) return {};
    LUXEL_VK(
        vkWaitForFences(context().device, 1, &fence_, VK_TRUE, std::numeric_limits<std::uint64_t>::max()),
        "recorder");
    std::vector<PassTime> times = read_times();
    reset();
    return times;
}

std::vector<PassTime> Commands::read_times() {
    const double period_ms = double(context().properties.limits.timestampPeriod) * 1e-6;
    std::vector<std::uint64_t> ticks(stamps_);
    for (std::size_t first = 0; first < ticks.size(); first += queries_per_pool) {
        const std::size_t count = std::min<std::size_t>(queries_per_pool, ticks.size() - first);
        LUXEL_VK(vkGetQueryPoolResults(context().device, queries_[first / queries_per_pool], 0,
                                       std::uint32_t(count), count * sizeof(std::uint64_t), &ticks[first],
                                       sizeof(std::uint64_t),
                                       VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
                 "timestamps");
    }
    // A pass lasts from the end of the pass before it to its own end, so that nothing between the submit's
    // first stamp and its last is lost. A stamp at the pass's own begin would not do: CPU drivers write it
    // together with the pass's results, when the pass is over.
    std::vector<PassTime> times;
    for (std::size_t i = 0; i < passes_.size(); ++i)
        times.push_back({passes_[i], double(ticks[i + 1] - ticks[i]) * period_ms});
    return times;
}

void Commands::reset() {
    LUXEL_VK(vkResetFences(context().device, 1, &fence_), "recorder");
    LUXEL_VK(vkResetCommandPool(context().device, pool_, 0), "recorder");
    started_ = false;
    stamps_ = 0;
    events_.clear();
    passes_.clear();
    index_.clear();
    resources_.clear();
    kept_.clear();
}

} // namespace luxel::gpu
