// SPDX-License-Identifier: MIT
// Dispatches, scopes and submission.
#include "gpu/recorder.h"

#include <utility>

#include "gpu/check.h"
#include "gpu/recorder_data.h"

namespace luxel::gpu {

Recorder::Recorder(Gpu& gpu) : gpu_(gpu), data_(std::make_unique<Data>(gpu.data())) {}
Recorder::~Recorder() = default;

Recorder::Scope::~Scope() { recorder_.data_->commands.pop_scope(); }

Recorder::Scope Recorder::scope(std::string name) {
    data_->commands.push_scope(std::move(name));
    return Scope(*this);
}

std::vector<PassTime> Recorder::submit() {
    flush();
    return std::exchange(flushed_, {});
}

void Recorder::flush() {
    const std::vector<PassTime> times = data_->commands.submit();
    if (!gpu_.data().faults.skip_wait) data_->descriptors.reset();
    flushed_.insert(flushed_.end(), times.begin(), times.end());
}

// C++ pads a struct to its alignment, scalar layout does not.
void check_params(const Program& program, std::span<const std::byte> params) {
    const std::uint64_t size = program.params ? program.params->shader.block_size : 0;
    constexpr std::uint64_t largest_alignment = 8;
    const std::uint64_t padded = (size + largest_alignment - 1) / largest_alignment * largest_alignment;
    LUXEL_ASSERT(params.size() == size || params.size() == padded,
                 "{}: params has {} bytes in the shader, {} in C++", program.name, size, params.size());
}

void Recorder::Data::use_bindings(const Program& program, std::uint32_t set, const Bindings& bindings) {
    for (const Binding& given : bindings) {
        const ProgramBinding& b = find_binding(program, set, given.name);
        if (const auto* image = std::get_if<Image>(&given.resource)) {
            const bool storage = b.shader.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
            LUXEL_ASSERT(*image, "{}: the image for \"{}\" is empty", program.name, given.name);
            // An unqualified storage image may be meant for writing only: not a read of what is undefined.
            commands.use(*image, b.uses,
                         storage ? VK_IMAGE_LAYOUT_GENERAL : sampled_layout(image->info().format),
                         (b.uses & use::writing) == 0);
        } else {
            const Buffer& buffer = std::get<Buffer>(given.resource);
            LUXEL_ASSERT(buffer, "{}: the buffer for \"{}\" is empty", program.name, given.name);
            commands.use(buffer, b.uses, (b.uses & use::writing) == 0);
        }
    }
}

void Recorder::Data::bind_set(VkPipelineBindPoint point, const Program& program, std::uint32_t set,
                              std::span<const std::byte> params, const Bindings& bindings) {
    const VkDescriptorSet made = descriptors.make(commands.gpu(), program, set, params, bindings);
    if (made) vkCmdBindDescriptorSets(commands.buffer(), point, program.layout, set, 1, &made, 0, nullptr);
}

void Recorder::dispatch_bytes(std::string_view name, Extent threads, std::span<const std::byte> params,
                              const Bindings& bindings) {
    Program& program = gpu_.data().program(name);
    LUXEL_ASSERT(program.compute, "{} is not a compute shader", name);
    check_params(program, params);
    const std::array<std::uint32_t, 3> counts{threads.x, threads.y, threads.z};
    std::array<std::uint32_t, 3> groups{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t size = program.local_size[axis];
        groups[axis] = counts[axis] / size + (counts[axis] % size != 0);
        const std::uint32_t most = gpu_.data().context->properties.limits.maxComputeWorkGroupCount[axis];
        if (groups[axis] > most)
            fail(Fault::resource, "gpu: {}: {} work groups, but {} allows {}", name, groups[axis],
                 gpu_.device().name, most);
    }

    Commands& commands = data_->commands;
    data_->use_bindings(program, 0, bindings);
    commands.begin(program.name);
    vkCmdBindPipeline(commands.buffer(), VK_PIPELINE_BIND_POINT_COMPUTE, program.compute);
    data_->bind_set(VK_PIPELINE_BIND_POINT_COMPUTE, program, 0, params, bindings);
    vkCmdDispatch(commands.buffer(), groups[0], groups[1], groups[2]);
    commands.end();
}

void Recorder::dispatch_indirect_bytes(std::string_view name, const Buffer& arguments, std::uint64_t offset,
                                       std::span<const std::byte> params, const Bindings& bindings) {
    Program& program = gpu_.data().program(name);
    LUXEL_ASSERT(program.compute, "{} is not a compute shader", name);
    LUXEL_ASSERT(offset % 4 == 0 && offset + 12 <= arguments.size(), "{}: arguments at {} of {} bytes of {}",
                 name, offset, arguments.size(), arguments.name());
    check_params(program, params);

    Commands& commands = data_->commands;
    data_->use_bindings(program, 0, bindings);
    commands.use(arguments, use::indirect, true);
    commands.begin(program.name);
    vkCmdBindPipeline(commands.buffer(), VK_PIPELINE_BIND_POINT_COMPUTE, program.compute);
    data_->bind_set(VK_PIPELINE_BIND_POINT_COMPUTE, program, 0, params, bindings);
    vkCmdDispatchIndirect(commands.buffer(), arguments.data_->storage.buffer, offset);
    commands.end();
}

} // namespace luxel::gpu
