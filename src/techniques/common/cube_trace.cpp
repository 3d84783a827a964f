// SPDX-License-Identifier: MIT
#include "techniques/common/cube_trace.h"

#include <algorithm>
#include <bit>

#include <fmt/core.h>

#include "techniques/common/cube_view_params.h"

namespace luxel {

void CubeTraceOptions::visit(Visitor& v, CubeSearch search) {
    const auto marched = [&](const auto& declare) {
        v.only_if(search >= CubeSearch::linear, "search=linear, secant or binary", declare);
    };
    v.integer("size", size, {16, 2048}, "texels a side of a cube face; rounded up to a power of two");
    marched([&] {
        v.choice("near", near, {"peeled", "faces"},
                 "layers of specular surfaces: by depth, or front and back sides");
        v.only_if(near == NearLayers::peeled, "near=peeled", [&] {
            v.integer("layers", layers, {1, 8}, "specular layers when peeled");
        });
        v.integer("linear", linear, {1, 4096}, "linear steps at most, for a half turn around the center");
    });
    v.integer("refine", refine, {0, 64}, "secant, binary or parallax steps");
    v.real("jump", jump, {0.001, 1000}, "change of distance over two texels, as a share, that is a gap");
    v.integer("depth", depth, {1, 8}, "specular surfaces on a path, the first included");
    v.choice("maps", maps, {"one", "each"},
             "a distance cube in the middle of all specular objects, or one at each");
}

void CubePathOptions::visit(Visitor& v) {
    v.choice("search", search, cube_search_names,
             "how rays meet the distance map; none = environment mapping, parallax = corrected once per "
             "refine step");
    v.real("least_weight", least_weight, {0, 1}, "branches that would add less than this share are dropped");
    v.flag("both", both, "follow reflection and refraction; off: the greater of them");
}

Need specular_need(const std::vector<SceneObject>& specular) {
    return {"a mirror, smooth metal or glass", !specular.empty()};
}

namespace {

Bounds union_of(const std::vector<Bounds>& boxes) {
    Bounds all;
    for (const Bounds& b : boxes) all.add(b.least), all.add(b.most);
    return all;
}

} // namespace

std::vector<Bounds> group_boxes(const std::vector<Bounds>& boxes, std::size_t most) {
    std::vector<std::vector<Bounds>> groups;
    if (!boxes.empty()) groups.push_back(boxes);
    auto width = [](const std::vector<Bounds>& g) { return g.size() > 1 ? union_of(g).radius() : -1.0f; };
    while (groups.size() < std::min(most, boxes.size())) {
        auto widest = std::max_element(groups.begin(), groups.end(),
                                       [&](const auto& a, const auto& b) { return width(a) < width(b); });
        const glm::vec3 extent = union_of(*widest).most - union_of(*widest).least;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        std::stable_sort(widest->begin(), widest->end(), [axis](const Bounds& a, const Bounds& b) {
            return a.center()[axis] < b.center()[axis];
        });
        const auto middle = widest->begin() + std::ptrdiff_t(widest->size() / 2);
        std::vector<Bounds> half(middle, widest->end());
        widest->erase(middle, widest->end());
        groups.push_back(std::move(half));
    }
    std::vector<Bounds> unions;
    for (const auto& group : groups) unions.push_back(union_of(group));
    return unions;
}

std::vector<Bounds> bounds_of_maps(const GpuScene& scene, const std::vector<SceneObject>& specular,
                                   DistanceMaps maps) {
    std::vector<Bounds> bounds;
    for (const SceneObject& object : specular)
        if (const Bounds b = scene.bounds_of(object.instances); !b.empty()) bounds.push_back(b);
    const std::size_t most = maps == DistanceMaps::one ? 1 : std::size_t(shared::CUBE_MAX_OBJECTS);
    // Objects keep their order where each has a cube of its own.
    return bounds.size() <= most ? bounds : group_boxes(bounds, most);
}

std::vector<std::string> shared_maps_warning(const std::vector<SceneObject>& specular, DistanceMaps maps) {
    if (maps == DistanceMaps::one || specular.size() <= std::size_t(shared::CUBE_MAX_OBJECTS)) return {};
    return {fmt::format("{} specular objects share {} distance cubes, the most that are drawn; those close "
                        "together have one, and it sees less of each",
                        specular.size(), shared::CUBE_MAX_OBJECTS)};
}

shared::CubeObjects cube_objects(const std::vector<Bounds>& maps) {
    shared::CubeObjects o{.own = 0, .count = int(maps.size())};
    for (std::size_t i = 0; i < maps.size(); ++i)
        o.sphere[i] = {maps[i].center(), std::max(maps[i].radius(), 1e-6f)};
    return o;
}

gpu::Bindings first_surfaces(const Capture& seen) {
    const GBuffer& g = seen.gbuffer;
    return {{"depth", g.depth},     {"normal", g.normal},     {"geometric_normal", g.geometric_normal},
            {"diffuse", g.diffuse}, {"specular", g.specular}, {"direct", seen.direct}};
}

gpu::Bindings TracedCube::bindings() const {
    using gpu::Sampler;
    return {{"radiance_map", cube.radiance, Sampler::linear_clamp},
            {"normal_map", cube.normal, Sampler::linear_clamp},
            {"material_map", cube.material, Sampler::nearest_clamp},
            {"distance_map", cube.distance, Sampler::linear_clamp},
            {"ranges", ranges}};
}

TracedCube capture_traced_cube(gpu::Recorder& recorder, const Frame& frame,
                               const std::vector<SceneObject>& specular, glm::vec3 center,
                               const CubeTraceOptions& options, CubeSearch search, CubeRadiance radiance,
                               const std::string& prefix) {
    const Scene& scene = frame.scene->scene();
    const bool marched = search >= CubeSearch::linear;
    CubeRequest request{.center = center,
                        .size = int(std::bit_ceil(unsigned(options.size))),
                        .layers = {},
                        .indirect = radiance == CubeRadiance::lit,
                        .min_max = marched,
                        .prefix = prefix};
    // Specular surfaces send paths on; their own light is not asked for.
    if (marched)
        request.layers = options.near == NearLayers::faces
                             ? face_layers(only(scene, specular), false)
                             : peeled_layers(only(scene, specular), options.layers, false);
    const int near_layers = int(request.layers.size());
    request.layers.push_back({.drawn = all_but(scene, specular), .lit = radiance != CubeRadiance::emitted});

    TracedCube traced;
    traced.cube = capture_cube(recorder, frame, request);
    const int layers = traced.cube.layers;
    traced.params = {.center = center,
                     .layers = layers,
                     .near_layers = near_layers,
                     .search = {.linear = options.linear,
                                .refine = options.refine,
                                .jump = options.jump,
                                .texel = 2.0f / float(request.size)},
                     .depth = options.depth};
    traced.environment = frame.environment;
    traced.environment_rotation = scene.environment.rotation;
    traced.environment_scale = scene.environment.empty() ? 0.0f : scene.environment.scale;
    traced.ranges =
        recorder.image({.width = std::uint32_t(layers), .height = 1, .format = VK_FORMAT_R32G32_SFLOAT},
                       prefix + "cube ranges");
    if (!marched) {
        recorder.clear(traced.ranges, {});
        return traced;
    }
    std::vector<int> instances;
    for (const SceneObject& object : specular)
        instances.insert(instances.end(), object.instances.begin(), object.instances.end());
    const shared::CubeRangeParams p{.layers = layers,
                                    .near_layers = near_layers,
                                    .near_most = farthest_corner(frame.scene->bounds_of(instances), center),
                                    .far_most = farthest_corner(frame.scene->bounds(), center)};
    const gpu::Image coarsest =
        traced.cube.min_max.mip(std::uint32_t(std::bit_width(unsigned(request.size)) - 1));
    recorder.dispatch("common/cube_range.comp", {std::uint32_t(layers), 1, 1}, p,
                      {{"coarsest", coarsest}, {"ranges", traced.ranges}});
    return traced;
}

void trace_view(gpu::Recorder& recorder, const Capture& seen, const TracedCube& traced,
                const shared::CubeObjects& objects, const CubePathOptions& paths, const gpu::Image& sum) {
    const shared::CubeViewParams p{.view = seen.view,
                                   .cube = traced.params,
                                   .objects = objects,
                                   .least_weight = paths.least_weight,
                                   .both = paths.both ? 1u : 0u,
                                   .environment_rotation = traced.environment_rotation,
                                   .environment_scale = traced.environment_scale};
    gpu::Bindings bindings = traced.bindings();
    const gpu::Bindings first = first_surfaces(seen);
    bindings.insert(bindings.end(), first.begin(), first.end());
    bindings.push_back({"sum", sum});
    bindings.push_back({"environment", traced.environment});
    recorder.dispatch("common/cube_view_" + cube_search_names[std::size_t(paths.search)] + ".comp",
                      extent_of(sum), p, bindings);
}

} // namespace luxel
