// SPDX-License-Identifier: MIT
#include "techniques/distance_map/distance_map.h"

namespace luxel {

void DistanceMap::visit(Visitor& v) {
    paths_.visit(v);
    options_.visit(v, paths_.search);
    v.flag("indirect", indirect_,
           "mirrors and glass also show ambient light and what the frame's other techniques light");
}

void DistanceMap::prepare(gpu::Gpu&, const Scene& scene) { objects_ = specular_objects(scene); }

Contribution DistanceMap::render(gpu::Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope("distance_map");
    gpu::Image reflections = recorder.image(
        {.width = frame.width, .height = frame.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT},
        "distance_map reflections");
    recorder.clear(reflections, {0, 0, 0, 1});
    const std::vector<Bounds> bounds = bounds_of_maps(*frame.scene, objects_, options_.maps);
    shared::CubeObjects objects = cube_objects(bounds);
    for (objects.own = 0; objects.own < objects.count; ++objects.own) {
        const TracedCube traced =
            capture_traced_cube(recorder, frame, objects_, bounds[std::size_t(objects.own)].center(),
                                options_, paths_.search, indirect_ ? CubeRadiance::lit : CubeRadiance::direct,
                                "distance_map " + std::to_string(objects.own) + " ");
        trace_view(recorder, frame, traced, objects, paths_, reflections);
    }
    return {.radiance = reflections};
}

std::unique_ptr<Technique> make_distance_map() { return std::make_unique<DistanceMap>(); }

} // namespace luxel
