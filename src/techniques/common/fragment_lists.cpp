// SPDX-License-Identifier: MIT
#include "techniques/common/fragment_lists.h"

#include <bit>

#include "core/error.h"
#include "shared/brdf.h"

namespace luxel {
namespace {

constexpr std::uint32_t node_bytes = 16;
constexpr std::array<float, 4> nothing{-1e30f, -1e30f, 0, 0}; // -least and greatest depth of an empty list
// Every device can bind 128 MiB as one storage buffer.
constexpr std::uint32_t most_nodes = (128u << 20) / node_bytes;

// From clip space of the world to pixels of positions relative to the center; row 0 on top.
glm::mat4 to_pixel(const glm::mat4& world_to_clip, const Axes& axes, glm::vec3 center, int side) {
    const glm::mat4 rows = glm::transpose(world_to_clip);
    const float half = 0.5f * float(side);
    const glm::vec4 depth(axes.forward, -glm::dot(axes.forward, axes.position));
    const glm::mat4 world =
        glm::transpose(glm::mat4(half * (rows[3] + rows[0]), half * (rows[3] - rows[1]), depth, rows[3]));
    glm::mat4 moved(1.0f);
    moved[3] = glm::vec4(center, 1.0f);
    return world * moved;
}

shared::ListView list_view(const glm::mat4& world_to_clip, const Axes& axes, const Bounds& scene, int side) {
    shared::ListView v{};
    v.center = scene.center();
    v.to_pixel = to_pixel(world_to_clip, axes, v.center, side);
    v.side = side;
    v.levels = 1 + std::countr_zero(unsigned(side)); // as long as four cells are one of the next level
    v.longest = 2.0f * scene.radius() + glm::length(axes.position - v.center);
    v.pixel = 2.0f * std::max(glm::length(axes.right), glm::length(axes.up)) / float(side);
    return v;
}

std::vector<shared::ListMaterial> list_materials(const Scene& scene) {
    std::vector<shared::ListMaterial> materials;
    for (const Instance& instance : scene.instances) {
        const Material& m = scene.materials[std::size_t(scene.meshes[std::size_t(instance.mesh)].material)];
        // As the G-buffer has it: metals do not transmit, and what transmits leaves the lobes less.
        const float transmission = m.transmission * (1.0f - m.metallic);
        const float ior = shared::signed_ior(m.metallic, m.roughness, transmission, m.ior, m.thin);
        const shared::Brdf brdf = shared::scale_brdf(
            shared::make_brdf(m.base_color, m.metallic, m.roughness, m.ior, m.specular, m.specular_color),
            ior > 0.0f ? 1.0f : 1.0f - transmission);
        materials.push_back({.f0 = brdf.f0,
                             .ior = ior,
                             .f90 = brdf.f90.x,
                             .roughness = shared::is_mirror(m.metallic, m.roughness)
                                              ? 0.0f
                                              : std::max(m.roughness, shared::MIRROR_ROUGHNESS)});
    }
    return materials;
}

} // namespace

ListProjection list_view_of_camera(const shared::ViewParams& camera, const Bounds& scene, int side,
                                   float margin) {
    const Axes axes{camera.position, camera.forward, camera.right * (1.0f + margin),
                    camera.up * (1.0f + margin)};
    const glm::mat4 to_clip = perspective_to_clip(axes, camera.near);
    shared::ListView view = list_view(to_clip, axes, scene, side);
    view.near = camera.near;
    return {view, to_clip};
}

ListProjection list_view_of_box(const Bounds& scene, int side) {
    const float radius = scene.radius() * 1.001f;
    const glm::vec3 forward = -glm::normalize(glm::vec3(1.0f));
    const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0, 1, 0)));
    const glm::vec3 up = glm::cross(right, forward);

    // As wide and high as the box's corners are.
    glm::vec2 most(1e-4f);
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner =
            glm::vec3((i & 1) ? scene.most.x : scene.least.x, (i & 2) ? scene.most.y : scene.least.y,
                      (i & 4) ? scene.most.z : scene.least.z) -
            scene.center();
        most = glm::max(most, glm::abs(glm::vec2(glm::dot(corner, right), glm::dot(corner, up))));
    }
    most *= 1.001f;
    const Axes axes{scene.center() - forward * radius, forward, right * most.x, up * most.y};
    const glm::mat4 to_clip = orthographic_to_clip(axes, 0.0f, 2.0f * radius);
    return {list_view(to_clip, axes, scene, side), to_clip};
}

FragmentLists::FragmentLists(gpu::Gpu& gpu, const Scene& scene) {
    materials_ = gpu.upload(std::span<const shared::ListMaterial>(list_materials(scene)), "list materials");
    count_ = gpu.buffer(4, "list count");
}

gpu::Bindings FragmentLists::bindings() const { return {{"heads", heads_}, {"nodes", nodes_}}; }

std::uint64_t FragmentLists::bytes() const {
    return heads_.size() + nodes_.size() + shading_.size() + min_max_.bytes();
}

// All surfaces that the view may see, opaque and masked ones.
void FragmentLists::draw(gpu::Recorder& recorder, const GpuScene& scene, gpu::RasterPass pass,
                         const std::string& program, const gpu::Bindings& targets) const {
    const shared::ListCaptureParams p{projection_.view, projection_.world_to_clip, capacity};
    const Frustum frustum = frustum_of(projection_.world_to_clip);
    for (const bool masked : {false, true}) {
        const MaterialUse use = masked ? MaterialUse::alpha : MaterialUse::none;
        const auto batches = scene.batches(frustum, masked ? Surfaces::masked : Surfaces::opaque, use);
        if (masked && batches.empty()) continue;
        gpu::Bindings bindings = targets;
        bindings.push_back({"materials", materials_});
        for (const gpu::Binding& b : scene.vertex_bindings(MaterialUse::all))
            if (b.name != "tangents" && (masked || (b.name != "texcoords" && b.name != "colors")))
                bindings.push_back(b);
        recorder.draw(masked ? program + "_masked" : program, pass, p, bindings, scene.indices(), batches);
        for (gpu::ColorTarget& target : pass.color) target.clear.reset();
        if (pass.depth) pass.depth->clear.reset();
    }
}

void FragmentLists::begin(gpu::Recorder& recorder, const ListProjection& projection, std::uint32_t nodes) {
    projection_ = projection;
    const std::uint32_t side = std::uint32_t(projection.view.side);
    heads_ = recorder.gpu().buffer(std::uint64_t(side) * side * 4, "list heads");
    min_max_ = recorder.image({.width = side,
                               .height = side,
                               .format = VK_FORMAT_R32G32_SFLOAT,
                               .mips = std::uint32_t(projection.view.levels)},
                              "list depths");
    reserve(recorder.gpu(), nodes);
}

void FragmentLists::reserve(gpu::Gpu& gpu, std::uint32_t nodes) {
    if (nodes > most_nodes)
        fail(Fault::resource,
             "fragment lists: {} fragments in {}x{} pixels, more than the {} that one GPU buffer holds; "
             "take a lower resolution or fewer layers",
             nodes, projection_.view.side, projection_.view.side, most_nodes);
    if (nodes_ && nodes_.size() >= std::uint64_t(nodes) * node_bytes) return;
    capacity = std::min(std::bit_ceil(nodes), most_nodes);
    nodes_ = gpu.buffer(std::uint64_t(capacity) * node_bytes, "list nodes");
    shading_ = gpu.buffer(std::uint64_t(capacity) * 4, "list shading normals");
}

void FragmentLists::finish(gpu::Recorder& recorder) {
    for (int level = 1; level < projection_.view.levels; ++level) {
        const gpu::Image to = min_max_.mip(std::uint32_t(level));
        recorder.dispatch("common/fragment_lists_mip.comp", extent_of(to), gpu::Recorder::NoParams{},
                          {{"from", min_max_.mip(std::uint32_t(level - 1))}, {"to", to}});
    }
}

void FragmentLists::capture(gpu::Recorder& recorder, const GpuScene& scene,
                            const ListProjection& projection) {
    auto scope = recorder.scope("lists");
    begin(recorder, projection, capacity);
    const gpu::RasterPass pass{.color = {{min_max_.mip(0), nothing, gpu::Blend::max}}};

    // The count is only known when the scene has been drawn.
    while (true) {
        recorder.fill(heads_, shared::LIST_END);
        recorder.fill(count_, 1);
        draw(recorder, scene, pass, "common/fragment_lists",
             {{"heads", heads_}, {"nodes", nodes_}, {"shading", shading_}, {"count", count_}});
        recorder.flush();
        recorder.gpu().read(count_, std::as_writable_bytes(std::span(&used_, 1)));
        if (used_ <= capacity) break;
        reserve(recorder.gpu(), used_);
    }
    finish(recorder);
}

void FragmentLists::capture_layers(gpu::Recorder& recorder, const GpuScene& scene,
                                   const ListProjection& projection, int layers) {
    auto scope = recorder.scope("layers");
    const std::uint32_t side = std::uint32_t(projection.view.side);
    begin(recorder, projection, std::uint32_t(layers) * side * side + 1);
    recorder.fill(heads_, shared::LIST_END);
    recorder.clear(min_max_.mip(0), nothing);
    auto image = [&](VkFormat format, const char* name) {
        return recorder.image({.width = side, .height = side, .format = format}, name);
    };
    const gpu::Image node = image(VK_FORMAT_R32G32B32A32_UINT, "layer node");
    const gpu::Image normal = image(VK_FORMAT_R32_UINT, "layer shading normal");
    const gpu::Image range = image(VK_FORMAT_R32G32_SFLOAT, "layer range");
    const gpu::Image hardware = image(VK_FORMAT_D32_SFLOAT, "layer hardware depth");
    const gpu::Image depths[] = {image(VK_FORMAT_R32_SFLOAT, "layer depth"),
                                 image(VK_FORMAT_R32_SFLOAT, "last layer's depth")};
    recorder.clear(depths[1], {});

    const std::array<float, 4> black{};
    for (int layer = 0; layer < layers; ++layer) {
        const gpu::Image &depth = depths[layer % 2], &last = depths[1 - layer % 2];
        const gpu::RasterPass pass{.color = {{node, black}, {normal, black}, {range, black}, {depth, black}},
                                   .depth = gpu::DepthTarget{.image = hardware,
                                                             .clear = 0.0f,
                                                             .compare = VK_COMPARE_OP_GREATER_OR_EQUAL}};
        draw(recorder, scene, pass, "common/fragment_layers", {{"farther_than", last}});
        recorder.dispatch("common/fragment_layers_link.comp", {side, side},
                          shared::ListLayerParams{int(side), layer},
                          {{"node", node},
                           {"shading_normal", normal},
                           {"range", range},
                           {"layer_depth", depth},
                           {"heads", heads_},
                           {"nodes", nodes_},
                           {"shading", shading_},
                           {"min_max", min_max_.mip(0)}});
    }
    finish(recorder);
}

} // namespace luxel
