// SPDX-License-Identifier: MIT
// A command buffer that knows how its commands use images and buffers. Declare the uses of the next command,
// call begin(), record it, call end(): barriers, labels and timestamps are its own business.
//
// State is local until submit: what the first use of a resource requires is collected and met by a second,
// small command buffer that runs before. So recorders do not depend on the order in which others record or
// submit.
#pragma once
#include <deque>
#include <memory>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

#include "gpu/context.h"
#include "gpu/program.h"
#include "gpu/recorder.h"

namespace luxel::gpu {

class Commands {
public:
    explicit Commands(GpuData& gpu);
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    VkCommandBuffer buffer() const { return body_; }
    GpuData& gpu() { return gpu_; }
    Context& context() { return *gpu_.context; }

    // For the next command. reads_contents = false: nothing that was there before matters.
    void use(const Image& image, Uses uses, VkImageLayout layout, bool reads_contents);
    void use(const Buffer& buffer, Uses uses, bool reads_contents);
    void begin(const std::string& name);
    void end();
    // Keeps something alive until the work is done.
    void keep(std::shared_ptr<void> object) { kept_.push_back(std::move(object)); }

    void push_scope(std::string name);
    void pop_scope();

    // Runs and waits; empty afterwards.
    std::vector<PassTime> submit();

private:
    struct Sub {
        TrackState state;
        bool seen = false;
        bool initial =
            false; // only read so far, in one layout: later reads still fit into the first requirement
        Uses first_uses = 0;
        VkImageLayout first_layout = VK_IMAGE_LAYOUT_UNDEFINED;
        Uses pending = 0; // of the next command
        VkImageLayout pending_layout = VK_IMAGE_LAYOUT_UNDEFINED;
        bool pending_reads = false;
    };
    struct Resource {
        std::shared_ptr<ImageData> image; // either
        std::shared_ptr<BufferData> buffer_data;
        std::vector<Sub> subs; // [mip * layers + layer]; one for a buffer
        bool touched = false;
        const std::string& name() const { return image ? image->name : buffer_data->name; }
    };
    // What the verifier replays.
    struct Event {
        std::size_t resource, sub;
        std::string_view command; // the pass that it belongs to, in passes_
        std::variant<VerifierBarrier, VerifierAccess> what;
    };
    struct Barriers {
        std::vector<VkImageMemoryBarrier2> images;
        std::vector<VkBufferMemoryBarrier2> buffers;
    };

    Resource& resource_of(const Image& image);
    Resource& resource_of(const Buffer& buffer);
    void start();
    void stamp(VkCommandBuffer target);
    void require(Sub& sub, std::size_t resource, std::size_t index, Barriers& barriers);
    void add_barrier(std::size_t resource, std::size_t sub, const Transition& t, Barriers& barriers,
                     std::vector<Event>& events);
    void record(VkCommandBuffer target, const Barriers& barriers) const;
    void use_on_host();
    void enter_global_state(std::vector<Event>& events);
    void verify(const std::vector<Event>& events);
    std::vector<PassTime> read_times();
    void reset();

    GpuData& gpu_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer preamble_ = VK_NULL_HANDLE, body_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    bool started_ = false;
    std::vector<VkQueryPool> queries_;
    std::vector<Resource> resources_;
    std::unordered_map<void*, std::size_t> index_;
    std::vector<std::size_t> touched_;
    std::vector<Event> events_;
    std::deque<std::string> passes_; // names; pass i ends at timestamp i + 1, the submit begins at 0
    std::uint32_t stamps_ = 0;       // of this submit
    std::vector<std::string> scopes_;
    std::vector<std::shared_ptr<void>> kept_;
};

} // namespace luxel::gpu
