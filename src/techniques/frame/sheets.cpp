// SPDX-License-Identifier: MIT
#include "techniques/frame/sheets.h"

#include <array>
#include <limits>

#include "techniques/frame/view_params.h"

namespace luxel {
namespace {

struct SheetProgram {
    const char* program;
    Surfaces surfaces;
};
constexpr SheetProgram programs[] = {{"frame/sheet_plain", Surfaces::plain},
                                     {"frame/sheet_textured", Surfaces::textured},
                                     {"frame/sheet_full", Surfaces::full}};

// As much of a view as the fragments of sheets ask for.
shared::ViewParams view_of(const glm::mat4& world_to_clip) {
    const glm::mat4 rows = glm::transpose(world_to_clip);
    const glm::vec4 eye = glm::inverse(world_to_clip) * glm::vec4(0, 0, 1, 0); // w = 0: a direction
    shared::ViewParams view{.world_to_clip = world_to_clip, .far = std::numeric_limits<float>::max()};
    view.parallel = glm::vec3(rows[3]) == glm::vec3(0.0f) ? 1.0f : 0.0f;
    view.forward = glm::normalize(view.parallel > 0.5f ? -glm::vec3(rows[2]) : glm::vec3(rows[3]));
    if (view.parallel < 0.5f) view.position = glm::vec3(eye) / eye.w;
    return view;
}

} // namespace

bool sees_sheets(const GpuScene& scene, const glm::mat4& world_to_clip) {
    if (scene.sheets().empty()) return false;
    const Frustum frustum = frustum_of(world_to_clip);
    for (const SheetProgram& kind : programs)
        if (!scene.batches(frustum, kind.surfaces, MaterialUse::none, scene.sheets()).empty()) return true;
    return false;
}

void draw_sheets(gpu::Recorder& recorder, const GpuScene& scene, const glm::mat4& world_to_clip,
                 const gpu::Image& solid, const SheetTargets& targets) {
    constexpr std::array<float, 4> zero{};
    gpu::RasterPass pass{
        .color = {{targets.optical_depth, zero, gpu::Blend::add}, {targets.nearest, zero, gpu::Blend::max}},
        .depth = gpu::DepthTarget{.image = solid, .write = false, .compare = VK_COMPARE_OP_GREATER_OR_EQUAL}};
    const Frustum frustum = frustum_of(world_to_clip);
    const shared::ViewParams view = view_of(world_to_clip);
    for (const SheetProgram& kind : programs) {
        const std::vector<gpu::Batch> batches =
            scene.batches(frustum, kind.surfaces, MaterialUse::all, scene.sheets());
        if (batches.empty() && kind.surfaces != Surfaces::plain) continue; // the first clears
        recorder.draw(kind.program, pass, view, scene.vertex_bindings(MaterialUse::all), scene.indices(),
                      batches);
        for (gpu::ColorTarget& target : pass.color) target.clear.reset();
    }
}

} // namespace luxel
