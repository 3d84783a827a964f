// SPDX-License-Identifier: MIT
// Descriptor sets and parameter blocks of one recorder; all are free again after its submit.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "gpu/program.h"

namespace luxel::gpu {

class Descriptors {
public:
    explicit Descriptors(std::shared_ptr<Context> context) : context_(std::move(context)) {}
    ~Descriptors();
    Descriptors(const Descriptors&) = delete;
    Descriptors& operator=(const Descriptors&) = delete;

    // The set of that number with all its used bindings. VK_NULL_HANDLE where the program has no such set.
    VkDescriptorSet make(const GpuData& gpu, const Program& program, std::uint32_t set,
                         std::span<const std::byte> params, const Bindings& bindings);
    void reset();

private:
    struct Place {
        VkBuffer buffer;
        std::uint64_t offset;
    };
    VkDescriptorSet allocate(const Program& program, VkDescriptorSetLayout layout);
    Place write_params(std::span<const std::byte> params);

    std::shared_ptr<Context> context_;
    std::vector<VkDescriptorPool> pools_;
    std::size_t pool_ = 0; // the one in use
    std::vector<Buffer> rings_;
    std::size_t ring_ = 0;
    std::uint64_t ring_offset_ = 0;
};

// The program's binding of that name in the set, for assertions that name both.
const ProgramBinding& find_binding(const Program& program, std::uint32_t set, std::string_view name);

} // namespace luxel::gpu
