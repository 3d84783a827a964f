// SPDX-License-Identifier: MIT
#include "techniques/distance_map/distance_map.h"

#include "techniques/distance_map/distance_map_params.h"

namespace luxel {

void DistanceMap::visit(Visitor& v) { options_.visit(v); }

void DistanceMap::prepare(gpu::Gpu&, const Scene& scene) { objects_ = specular_objects(scene); }

Contribution DistanceMap::render(gpu::Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope("distance_map");
    gpu::Image reflections = recorder.image(
        {.width = frame.width, .height = frame.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT},
        "distance_map reflections");
    recorder.clear(reflections, {0, 0, 0, 1});
    const std::vector<Bounds> bounds = bounds_of_maps(*frame.scene, objects_, options_.maps);
    shared::DistanceMapParams p{.view = frame.view, .objects = cube_objects(bounds)};

    const gpu::Bindings first = first_surfaces(frame);
    const std::string program =
        "distance_map/trace_" + cube_search_names[std::size_t(options_.search)] + ".comp";
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        const TracedCube traced = capture_traced_cube(recorder, frame, objects_, bounds[i].center(), options_,
                                                      "distance_map " + std::to_string(i) + " ");
        p.cube = traced.params, p.objects.own = int(i);
        gpu::Bindings bindings = traced.bindings();
        bindings.insert(bindings.end(), first.begin(), first.end());
        bindings.push_back({"reflections", reflections});
        recorder.dispatch(program, extent_of(reflections), p, bindings);
    }
    return {.radiance = reflections};
}

std::unique_ptr<Technique> make_distance_map() { return std::make_unique<DistanceMap>(); }

} // namespace luxel
