// SPDX-License-Identifier: MIT
#include "techniques/frame/blending.h"

#include <algorithm>

#include "techniques/frame/capture.h"

namespace luxel {

std::vector<bool> blended_instances(const Scene& scene) {
    std::vector<bool> blended;
    bool any = false;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        blended.push_back(scene.materials[std::size_t(mesh.material)].alpha_mode == AlphaMode::blend);
        any = any || blended.back();
    }
    return any ? blended : std::vector<bool>();
}

std::vector<Capture> blended_layers(gpu::Recorder& recorder, const GpuScene& scene,
                                    const shared::ViewParams& view, const std::vector<bool>& instances,
                                    int most, const std::optional<shared::HeightSearch>& search) {
    // A triangle is in one layer of a pixel at most.
    std::size_t triangles = 0;
    for (std::size_t i = 0; i < instances.size(); ++i)
        if (instances[i])
            triangles +=
                scene.scene().meshes[std::size_t(scene.scene().instances[i].mesh)].indices.size() / 3;
    const int count = int(std::min(triangles, std::size_t(most)));
    std::vector<Capture> layers;
    for (int i = 0; i < count; ++i) {
        CaptureRequest request{.view = view,
                               .prefix = "blended " + std::to_string(i) + " ",
                               .sides = Sides::seen,
                               .blended = true,
                               .drawn = instances};
        if (i > 0) request.farther_than = layers.back().gbuffer.depth;
        layers.push_back(capture_surfaces(recorder, scene, request, search));
    }
    return layers;
}

} // namespace luxel
