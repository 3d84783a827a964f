// SPDX-License-Identifier: MIT
// Programs by name: shader modules, layouts, and pipelines for the states that they are drawn with.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/context.h"
#include "gpu/recorder.h"
#include "gpu/reflection.h"

namespace luxel::gpu {

// A binding of the whole program: the uses of all its stages together.
struct ProgramBinding {
    ShaderBinding shader;
    VkShaderStageFlags stages = 0;
    Uses uses = 0;
    bool is(std::string_view name) const { return shader.name == name || shader.block == name; }
};

// What of a RasterPass a pipeline is compiled for; the rest is dynamic.
struct RasterState {
    std::vector<VkFormat> color_formats;
    std::vector<Blend> blends;
    VkFormat depth_format = VK_FORMAT_UNDEFINED;
    bool depth_write = false, depth_clamp = false, depth_bias = false;
    VkCompareOp depth_compare = VK_COMPARE_OP_ALWAYS;
    Cull cull = Cull::none;
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    auto operator<=>(const RasterState&) const = default;
};

struct Program {
    std::shared_ptr<Context> context;
    std::string name;
    std::vector<std::pair<VkShaderStageFlagBits, VkShaderModule>> modules;
    std::array<std::uint32_t, 3> local_size{1, 1, 1};
    std::uint32_t color_outputs = 0;
    std::vector<ProgramBinding> bindings;
    const ProgramBinding* params = nullptr; // the uniform block of that name
    std::vector<VkDescriptorSetLayout> set_layouts;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline compute = VK_NULL_HANDLE;
    std::map<RasterState, VkPipeline> raster;

    // name is a compute shader's file, or the common part of a .vert and a .frag.
    Program(std::shared_ptr<Context> c, std::string_view program);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    VkPipeline raster_pipeline(const RasterState& state);

private:
    void add_stage(std::string_view file, std::span<const std::uint32_t> words);
    void make_layouts();
    void make_compute();
};

// All that a Gpu has besides its device.
struct GpuData {
    // Test only: what the recorder is told to get wrong, to see that it is noticed.
    struct Faults {
        bool skip_barriers = false; // emit only layout transitions between the commands of one submit
        bool skip_entry = false;    // and between submits
        bool keep_hazards = false;  // the verifier's findings go into hazards instead of an assertion
        bool skip_wait = false;     // Recorder::submit returns at once
    };

    std::shared_ptr<Context> context;
    std::map<std::string, std::unique_ptr<Program>, std::less<>> programs;
    std::array<VkSampler, 6> samplers{};
    Faults faults;
    std::vector<std::string> hazards;

    explicit GpuData(const GpuOptions& options);
    ~GpuData();
    GpuData(const GpuData&) = delete;
    GpuData& operator=(const GpuData&) = delete;

    Program& program(std::string_view name);
};

} // namespace luxel::gpu
