// SPDX-License-Identifier: MIT
#include "techniques/distance_map/distance_map.h"

#include "core/error.h"
#include "techniques/distance_map/distance_map_params.h"

namespace luxel {

void DistanceMap::visit(Visitor& v) {
    options_.visit(v);
    v.choice("maps", maps_, {"one", "each"},
             "a distance cube in the middle of all specular objects, or one at each");
}

void DistanceMap::prepare(gpu::Gpu&, const Scene& scene) { objects_ = specular_objects(scene); }

namespace {

// What shares a map: its pixels and where its center is.
std::vector<Bounds> bounds_of_maps(const GpuScene& scene, const std::vector<SceneObject>& objects,
                                   DistanceMaps maps) {
    std::vector<Bounds> bounds;
    for (const SceneObject& object : objects) {
        Bounds b = scene.bounds_of(object.instances);
        if (b.empty()) continue;
        if (bounds.empty() || maps == DistanceMaps::each) bounds.emplace_back();
        bounds.back().add(b.least), bounds.back().add(b.most);
    }
    if (bounds.size() > std::size_t(shared::DISTANCE_MAP_MAX_OBJECTS))
        fail(Fault::usage,
             "distance_map: {} specular objects, at most {} can have a map of their own; use maps=one, or "
             "give objects "
             "that are close the same role",
             bounds.size(), shared::DISTANCE_MAP_MAX_OBJECTS);
    return bounds;
}

} // namespace

Contribution DistanceMap::render(gpu::Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope("distance_map");
    gpu::Image reflections = recorder.image(
        {.width = frame.width, .height = frame.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT},
        "distance_map reflections");
    recorder.clear(reflections, {});
    const std::vector<Bounds> bounds = bounds_of_maps(*frame.scene, objects_, maps_);
    shared::DistanceMapParams p{.view = frame.view, .objects = int(bounds.size())};
    for (std::size_t i = 0; i < bounds.size(); ++i)
        p.sphere[i] = {bounds[i].center(), std::max(bounds[i].radius(), 1e-6f)};

    const GBuffer& g = frame.gbuffer;
    const std::string program =
        "distance_map/trace_" + cube_search_names[std::size_t(options_.search)] + ".comp";
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        const TracedCube traced = capture_traced_cube(recorder, frame, objects_, bounds[i].center(), options_,
                                                      "distance_map " + std::to_string(i) + " ");
        p.cube = traced.params, p.object = int(i);
        gpu::Bindings bindings = traced.bindings();
        bindings.insert(bindings.end(), {{"depth", g.depth},
                                         {"normal", g.normal},
                                         {"geometric_normal", g.geometric_normal},
                                         {"diffuse", g.diffuse},
                                         {"specular", g.specular},
                                         {"direct", frame.direct},
                                         {"reflections", reflections}});
        recorder.dispatch(program, extent_of(reflections), p, bindings);
    }
    return {.radiance = reflections};
}

std::unique_ptr<Technique> make_distance_map() { return std::make_unique<DistanceMap>(); }

} // namespace luxel
