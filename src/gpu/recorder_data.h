// SPDX-License-Identifier: MIT
// What the parts of the recorder share.
#pragma once
#include "gpu/commands.h"
#include "gpu/descriptors.h"
#include "gpu/recorder.h"

namespace luxel::gpu {

struct Recorder::Data {
    Commands commands;
    Descriptors descriptors;

    explicit Data(GpuData& gpu) : commands(gpu), descriptors(gpu.context) {}

    // Declares what the program does with the resources given for one of its sets.
    void use_bindings(const Program& program, std::uint32_t set, const Bindings& bindings);
    void bind_set(VkPipelineBindPoint point, const Program& program, std::uint32_t set,
                  std::span<const std::byte> params, const Bindings& bindings);
};

VkClearColorValue clear_value(VkFormat format, std::array<float, 4> value);
void check_params(const Program& program, std::span<const std::byte> params);

// The transfers that Recorder and Gpu have in common.
void copy_buffer_to_image(Commands& commands, const Buffer& from, const Image& to);
void copy_image_to_buffer(Commands& commands, const Image& from, const Buffer& to);
void copy_buffer(Commands& commands, const Buffer& from, std::uint64_t from_offset, const Buffer& to,
                 std::uint64_t size);
void blit_mips(Commands& commands, const Image& image);

} // namespace luxel::gpu
