// SPDX-License-Identifier: MIT
#include "techniques/common/caustics.h"

#include <algorithm>

#include "shared/sampling.h"
#include "techniques/frame/projection.h"

namespace luxel {

void CausticOptions::visit(Visitor& v) {
    cube.visit(v);
    v.integer("photons", photons, {8, 2048}, "pixels a side of the photon image of each light and object");
    v.integer("caustic_size", size, {16, 2048}, "texels a side of the caustic cube map");
    v.flag("mirrored", mirrored, "also photons that glass reflects at its first surface");
    lights.visit(v);
}

namespace {

// Directional light comes from so many radii away: its rays diverge by a thousandth in the view, in which
// they are found; they are traced parallel.
constexpr float directional_radii = 1000.0f;
constexpr float widest = 4.0f; // tangent of the half angle of a light's view

// The light's view of a box. Its near plane is before the box, as other things may be in between.
shared::ViewParams light_view(const shared::Light& light, const Bounds& box, float scene_radius, int side) {
    const bool afar = light.type == shared::LIGHT_DIRECTIONAL;
    const float back = directional_radii * std::max(box.radius(), 1e-4f);
    Axes axes{afar ? box.center() - light.direction * back : light.position, {}, {}, {}};
    axes.forward = box.center() - axes.position;
    axes.forward = glm::length(axes.forward) > 0.0f ? glm::normalize(axes.forward) : glm::vec3(0, -1, 0);
    const glm::mat3 around = shared::frame_around(axes.forward);
    float x = 1e-4f, y = 1e-4f;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner((i & 1) ? box.most.x : box.least.x, (i & 2) ? box.most.y : box.least.y,
                               (i & 4) ? box.most.z : box.least.z);
        const glm::vec3 d = corner - axes.position;
        const float z = glm::dot(d, axes.forward);
        x = std::max(x, z > 0.0f ? std::abs(glm::dot(d, around[0])) / z : widest);
        y = std::max(y, z > 0.0f ? std::abs(glm::dot(d, around[1])) / z : widest);
    }
    // Right-handed, so that fronts are fronts. A pixel more on each side, for the neighbors of photons at the
    // rim.
    const float margin = 1.0f + 2.0f / float(side);
    axes.right = around[0] * (std::min(x, widest) * margin),
    axes.up = -around[1] * (std::min(y, widest) * margin);
    const float near = afar ? std::max(back - 2.0f * scene_radius, 0.01f * back) : 1e-4f * scene_radius;
    return view_params(axes, near, back + 4.0f * scene_radius, glm::vec2(float(side)));
}

Photons trace_photons(gpu::Recorder& recorder, const Capture& seen, const TracedCube& traced,
                      const shared::CausticPhotonParams& p) {
    const std::uint32_t side = seen.width;
    auto image = [&](const char* name) {
        return recorder.image({.width = side, .height = side, .format = VK_FORMAT_R32G32B32A32_SFLOAT}, name);
    };
    Photons photons{image("caustic hits"), image("caustic powers"), int(side)};
    gpu::Bindings bindings = traced.bindings(), first = first_surfaces(seen);
    bindings.insert(bindings.end(), first.begin(), first.end());
    bindings.insert(bindings.end(), {{"hits", photons.hits}, {"powers", photons.powers}});
    recorder.dispatch("common/caustic_photons.comp", extent_of(photons.hits), p, bindings);
    return photons;
}

bool any_refracts(const Scene& scene, const std::vector<SceneObject>& objects) {
    for (const SceneObject& object : objects)
        for (int i : object.instances) {
            const Mesh& mesh = scene.meshes[std::size_t(scene.instances[std::size_t(i)].mesh)];
            if (scene.materials[std::size_t(mesh.material)].transmission > 0.0f) return true;
        }
    return false;
}

std::vector<CausticFace> faces_of(const gpu::Image& caustic, const CausticOptions& options) {
    std::vector<CausticFace> faces;
    for (int face = 0; face < 6; ++face) {
        // As the texels lie, not mirrored as a camera in the center sees them.
        const shared::CubeAxes a = shared::cube_axes(face);
        const Axes axes{glm::vec3(0), a.forward, a.u, -a.v};
        faces.push_back({caustic.layer(std::uint32_t(face)),
                         {.to_clip = perspective_to_clip(axes, 1e-5f),
                          .face = face,
                          .size = options.size,
                          .radius = 1.5f,
                          .photons = options.photons}});
    }
    return faces;
}

// Adds to `radiance` what the surfaces of a view reflect.
void receive(gpu::Recorder& recorder, const Capture& seen, const CausticMap& map,
             const gpu::Image& radiance) {
    const shared::CausticReceiveParams p{seen.view, map.receivers.center, map.texel};
    const GBuffer& g = seen.gbuffer;
    recorder.dispatch("common/caustic_receive.comp", extent_of(radiance), p,
                      {{"depth", g.depth},
                       {"geometric_normal", g.geometric_normal},
                       {"diffuse", g.diffuse},
                       {"distance_map", map.receivers.distance, gpu::Sampler::linear_clamp},
                       {"caustic", map.irradiance, gpu::Sampler::linear_clamp},
                       {"radiance", radiance}});
}

} // namespace

struct CausticTechnique::Request {
    std::vector<shared::Light> lights;
    std::vector<Bounds> boxes; // of the maps
    bool refracts;             // any object does
};

void CausticTechnique::prepare(gpu::Gpu&, const Scene& scene) { objects_ = specular_objects(scene); }

// Photons of all lights by way of the object objects.own.
CausticMap CausticTechnique::map_of(gpu::Recorder& recorder, const Frame& frame, const Request& request,
                                    const shared::CubeObjects& objects) const {
    const Bounds& box = request.boxes[std::size_t(objects.own)];
    const TracedCube traced =
        capture_traced_cube(recorder, frame, objects_, box.center(), options_.cube, CubeSearch::secant,
                            CubeRadiance::emitted, "caustics " + std::to_string(objects.own) + " ");
    const std::uint32_t size = std::uint32_t(options_.size);
    const CausticMap map = {traced.cube.layer(traced.params.near_layers), traced.params.search.texel,
                            recorder.image({.width = size,
                                            .height = size,
                                            .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                            .layers = 6,
                                            .cube = true},
                                           "caustic cube")};
    recorder.clear(map.irradiance, {});
    const std::vector<CausticFace> faces = faces_of(map.irradiance, options_);
    for (const shared::Light& light : request.lights) {
        shared::CausticPhotonParams p{
            .view = light_view(light, box, frame.scene->bounds().radius(), options_.photons),
            .cube = traced.params,
            .objects = objects,
            .light = light};
        const Capture seen = frame.capture_surfaces(recorder, {.view = p.view, .prefix = "caustics light "});
        for (p.mirrored = 0; p.mirrored <= (request.refracts && options_.mirrored ? 1u : 0u); ++p.mirrored)
            draw(recorder, trace_photons(recorder, seen, traced, p), map.receivers, faces);
    }
    return map;
}

Contribution CausticTechnique::render(gpu::Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope(name_);
    gpu::Image radiance = recorder.image(
        {.width = frame.width, .height = frame.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT}, "caustics");
    recorder.clear(radiance, {0, 0, 0, 1});
    const Scene& scene = frame.scene->scene();
    const Request request{lights_with_samples(scene, options_.lights),
                          bounds_of_maps(*frame.scene, objects_, options_.cube.maps),
                          any_refracts(scene, objects_)};
    shared::CubeObjects objects = cube_objects(request.boxes);
    maps_.clear();
    for (objects.own = 0; objects.own < objects.count; ++objects.own) {
        maps_.push_back(map_of(recorder, frame, request, objects));
        receive(recorder, frame, maps_.back(), radiance);
    }
    return {.radiance = radiance};
}

void CausticTechnique::light(gpu::Recorder& recorder, const Frame&, const std::vector<Capture>& captures) {
    for (const CausticMap& map : maps_)
        for (const Capture& capture : captures) receive(recorder, capture, map, capture.direct);
}

void splat_photons(gpu::Recorder& recorder, const Photons& photons, const gpu::Image& powers,
                   const DistanceCube& receivers, const CausticFace& face, float radius) {
    shared::CausticFaceParams p = face.params;
    p.radius = radius;
    const gpu::RasterPass pass{.color = {{.image = face.target, .blend = gpu::Blend::add}}};
    const std::vector<gpu::Batch> all = {
        {.draws = {{.count = std::uint32_t(6 * photons.side * photons.side)}}}};
    recorder.draw("common/caustic_splat", pass, p,
                  {{"hits", photons.hits},
                   {"powers", powers},
                   {"normal_map", receivers.normal, gpu::Sampler::nearest_clamp}},
                  {}, all);
}

} // namespace luxel
