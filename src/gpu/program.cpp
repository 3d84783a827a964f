// SPDX-License-Identifier: MIT
#include "gpu/program.h"

#include <algorithm>

#include "gpu/check.h"
#include "gpu/shader_code.h"

namespace luxel::gpu {
namespace {

int use_stage(VkShaderStageFlagBits stage) {
    if (stage == VK_SHADER_STAGE_COMPUTE_BIT) return use::compute;
    return stage == VK_SHADER_STAGE_VERTEX_BIT ? use::vertex : use::fragment;
}

Uses uses_of(const ShaderBinding& b, VkShaderStageFlagBits stage) {
    if (!b.used) return 0;
    Uses uses = 0;
    switch (b.type) {
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
        uses = use::uniform;
        break;
    case VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER:
    case VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER:
        uses = use::sampled;
        break;
    default:
        uses = (b.reads ? use::storage_read : 0) | (b.writes ? use::storage_write : 0);
    }
    return use::in(use_stage(stage), uses);
}

VkPipelineColorBlendAttachmentState blend_state(Blend blend) {
    VkPipelineColorBlendAttachmentState state{.blendEnable = blend != Blend::none,
                                              .srcColorBlendFactor = VK_BLEND_FACTOR_ONE,
                                              .dstColorBlendFactor = VK_BLEND_FACTOR_ONE,
                                              .colorBlendOp = VK_BLEND_OP_ADD,
                                              .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                              .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                              .alphaBlendOp = VK_BLEND_OP_ADD,
                                              .colorWriteMask =
                                                  VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                                  VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT};
    if (blend == Blend::min) state.colorBlendOp = state.alphaBlendOp = VK_BLEND_OP_MIN;
    if (blend == Blend::max) state.colorBlendOp = state.alphaBlendOp = VK_BLEND_OP_MAX;
    return state;
}

VkCullModeFlags cull_mode(Cull cull) {
    if (cull == Cull::none) return VK_CULL_MODE_NONE;
    return cull == Cull::back ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_FRONT_BIT;
}

std::span<const std::uint32_t> find_code(std::string_view file) {
    for (const EmbeddedShader& s : embedded_shaders()) {
        if (s.name == file) return {s.words.begin, s.words.end};
    }
    return {};
}

} // namespace

Program::Program(std::shared_ptr<Context> c, std::string_view program)
    : context(std::move(c)), name(program) {
    const std::string vertex = name + ".vert", fragment = name + ".frag";
    if (name.ends_with(".comp")) {
        add_stage(name, find_code(name));
    } else {
        add_stage(vertex, find_code(vertex));
        if (!find_code(fragment).empty()) add_stage(fragment, find_code(fragment));
    }
    for (const ProgramBinding& b : bindings) {
        if (b.is("params") && b.shader.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER) params = &b;
    }
    LUXEL_ASSERT(!params || params->shader.set == 0, "{}: params belongs to set 0", name);
    make_layouts();
    if (name.ends_with(".comp")) make_compute();
}

Program::~Program() {
    for (const auto& [state, pipeline] : raster) vkDestroyPipeline(context->device, pipeline, nullptr);
    vkDestroyPipeline(context->device, compute, nullptr);
    vkDestroyPipelineLayout(context->device, layout, nullptr);
    for (VkDescriptorSetLayout set : set_layouts) vkDestroyDescriptorSetLayout(context->device, set, nullptr);
    for (const auto& [stage, module] : modules) vkDestroyShaderModule(context->device, module, nullptr);
}

void Program::add_stage(std::string_view file, std::span<const std::uint32_t> words) {
    LUXEL_ASSERT(!words.empty(), "there is no shader {}", file);
    const Reflection r = reflect(words, std::string(file));
    if (r.stage == VK_SHADER_STAGE_COMPUTE_BIT) local_size = r.local_size;
    if (r.stage == VK_SHADER_STAGE_FRAGMENT_BIT) color_outputs = r.color_outputs;

    // Both stages of a program may declare the same binding; then they have to agree.
    for (const ShaderBinding& b : r.bindings) {
        auto known = std::find_if(bindings.begin(), bindings.end(), [&](const ProgramBinding& p) {
            return p.shader.set == b.set && p.shader.binding == b.binding;
        });
        if (known == bindings.end()) {
            bindings.push_back({b, 0, 0});
            known = bindings.end() - 1;
        }
        LUXEL_ASSERT(known->shader.type == b.type && known->shader.block_size == b.block_size,
                     "{}: set {} binding {} ({}{}) is declared twice, differently", file, b.set, b.binding,
                     b.name, b.block);
        known->stages |= r.stage;
        known->uses |= uses_of(b, r.stage);
        known->shader.used |= b.used;
    }

    const VkShaderModuleCreateInfo create{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                          .codeSize = words.size_bytes(),
                                          .pCode = words.data()};
    VkShaderModule module = VK_NULL_HANDLE;
    LUXEL_VK(vkCreateShaderModule(context->device, &create, nullptr, &module), std::string(file));
    modules.emplace_back(r.stage, module);
}

void Program::make_layouts() {
    std::uint32_t sets = 0;
    for (const ProgramBinding& b : bindings) sets = std::max(sets, b.shader.set + 1);
    LUXEL_ASSERT(sets <= 2, "{} has {} descriptor sets; there are 2: the pass's and the batch's", name, sets);
    for (std::uint32_t set = 0; set < sets; ++set) {
        std::vector<VkDescriptorSetLayoutBinding> list;
        for (const ProgramBinding& b : bindings) {
            if (b.shader.set == set) list.push_back({b.shader.binding, b.shader.type, 1, b.stages, nullptr});
        }
        const VkDescriptorSetLayoutCreateInfo create{.sType =
                                                         VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                     .bindingCount = std::uint32_t(list.size()),
                                                     .pBindings = list.data()};
        set_layouts.push_back(VK_NULL_HANDLE);
        LUXEL_VK(vkCreateDescriptorSetLayout(context->device, &create, nullptr, &set_layouts.back()), name);
    }
    const VkPipelineLayoutCreateInfo create{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                            .setLayoutCount = std::uint32_t(set_layouts.size()),
                                            .pSetLayouts = set_layouts.data()};
    LUXEL_VK(vkCreatePipelineLayout(context->device, &create, nullptr, &layout), name);
}

void Program::make_compute() {
    const VkComputePipelineCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = modules[0].second,
                  .pName = "main"},
        .layout = layout};
    LUXEL_VK(vkCreateComputePipelines(context->device, nullptr, 1, &create, nullptr, &compute), name);
    context->set_name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(compute), name);
}

VkPipeline Program::raster_pipeline(const RasterState& state) {
    VkPipeline& pipeline = raster[state];
    if (pipeline) return pipeline;

    std::vector<VkPipelineShaderStageCreateInfo> stages;
    for (const auto& [stage, module] : modules)
        stages.push_back({.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                          .stage = stage,
                          .module = module,
                          .pName = "main"});
    std::vector<VkPipelineColorBlendAttachmentState> blends;
    for (const Blend b : state.blends) blends.push_back(blend_state(b));

    // Vertices are pulled by the shader; viewport, scissor and bias are dynamic.
    const VkPipelineVertexInputStateCreateInfo vertex_input{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO, .topology = state.topology};
    const VkPipelineViewportStateCreateInfo viewport{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1};
    const VkPipelineRasterizationStateCreateInfo rasterization{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .depthClampEnable = state.depth_clamp,
        .polygonMode = VK_POLYGON_MODE_FILL,
        .cullMode = cull_mode(state.cull),
        .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
        .depthBiasEnable = state.depth_bias,
        .lineWidth = 1.0f};
    const VkPipelineMultisampleStateCreateInfo multisample{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    const VkPipelineDepthStencilStateCreateInfo depth{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = state.depth_format != VK_FORMAT_UNDEFINED,
        .depthWriteEnable = state.depth_write,
        .depthCompareOp = state.depth_compare};
    const VkPipelineColorBlendStateCreateInfo blending{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = std::uint32_t(blends.size()),
        .pAttachments = blends.data()};
    const VkDynamicState dynamic_states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                             VK_DYNAMIC_STATE_DEPTH_BIAS};
    const VkPipelineDynamicStateCreateInfo dynamic{.sType =
                                                       VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
                                                   .dynamicStateCount = 3,
                                                   .pDynamicStates = dynamic_states};
    const VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                  .colorAttachmentCount =
                                                      std::uint32_t(state.color_formats.size()),
                                                  .pColorAttachmentFormats = state.color_formats.data(),
                                                  .depthAttachmentFormat = state.depth_format};
    const VkGraphicsPipelineCreateInfo create{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                              .pNext = &rendering,
                                              .stageCount = std::uint32_t(stages.size()),
                                              .pStages = stages.data(),
                                              .pVertexInputState = &vertex_input,
                                              .pInputAssemblyState = &assembly,
                                              .pViewportState = &viewport,
                                              .pRasterizationState = &rasterization,
                                              .pMultisampleState = &multisample,
                                              .pDepthStencilState = &depth,
                                              .pColorBlendState = &blending,
                                              .pDynamicState = &dynamic,
                                              .layout = layout};
    LUXEL_VK(vkCreateGraphicsPipelines(context->device, nullptr, 1, &create, nullptr, &pipeline), name);
    context->set_name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline), name);
    return pipeline;
}

} // namespace luxel::gpu
