// SPDX-License-Identifier: MIT
#include "techniques/frame/scene_depth.h"

#include "techniques/frame/displaced_params.h"

namespace luxel {
namespace {

shared::DisplacedDepthParams displaced_depth_params(const glm::mat4& world_to_clip,
                                                    const shared::HeightSearch& search) {
    // Rows of x and y, and the way that depth goes: w of a perspective, z (reversed) of a box.
    const glm::mat4 rows = glm::transpose(world_to_clip);
    const glm::vec3 along = glm::vec3(rows[3]) - glm::vec3(rows[2]);
    const float turn = glm::dot(glm::cross(glm::vec3(rows[0]), glm::vec3(rows[1])), along);
    return {.world_to_clip = world_to_clip,
            .eye = glm::inverse(world_to_clip) * glm::vec4(0, 0, 1, 0),
            .handedness = turn > 0.0f ? -1.0f : 1.0f,
            .search = search};
}

} // namespace

void draw_depth(gpu::Recorder& recorder, const GpuScene& scene, const glm::mat4& world_to_clip,
                const gpu::Image& map, const std::optional<shared::HeightSearch>& search,
                const std::vector<bool>& drawn) {
    const Frustum frustum = frustum_of(world_to_clip);
    const bool apart = search.has_value();
    gpu::RasterPass pass{
        .depth = gpu::DepthTarget{.image = map, .clear = 0.0f, .compare = VK_COMPARE_OP_GREATER_OR_EQUAL}};
    recorder.draw("frame/depth", pass, world_to_clip, scene.vertex_bindings(MaterialUse::none),
                  scene.indices(), scene.batches(frustum, Surfaces::opaque, MaterialUse::none, drawn, apart));
    pass.depth->clear.reset();
    const gpu::Bindings vertices = scene.vertex_bindings(MaterialUse::alpha);
    std::vector<gpu::Batch> masked =
        scene.batches(frustum, Surfaces::masked, MaterialUse::alpha, drawn, apart);
    if (!masked.empty())
        recorder.draw("frame/depth_mask", pass, world_to_clip, vertices, scene.indices(), masked);
    if (!apart) return;

    // Rays go on behind the polygons, too: reliefs shadow themselves.
    std::vector<gpu::Batch> reliefs = scene.batches(frustum, Surfaces::displaced, MaterialUse::alpha, drawn);
    if (reliefs.empty()) return;
    const shared::DisplacedDepthParams p = displaced_depth_params(world_to_clip, *search);
    recorder.draw("frame/depth_displaced", pass, p, vertices, scene.indices(), reliefs);
}

} // namespace luxel
