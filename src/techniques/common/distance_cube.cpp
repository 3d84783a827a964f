// SPDX-License-Identifier: MIT
#include "techniques/common/distance_cube.h"

#include <algorithm>
#include <bit>

#include "core/error.h"
#include "shared/cube.h"
#include "techniques/common/distance_cube_params.h"
#include "techniques/frame/projection.h"

namespace luxel {
namespace {

constexpr int faces = 6;

// The near plane lies this share of the farthest distance before the center.
constexpr float near_by_far = 1e-5f;

DistanceCube make_images(gpu::Recorder& recorder, const CubeRequest& request) {
    LUXEL_ASSERT(request.size > 0 && std::has_single_bit(unsigned(request.size)) && !request.layers.empty(),
                 "size={} layers={}", request.size, request.layers.size());
    DistanceCube cube{.center = request.center, .size = request.size, .layers = int(request.layers.size())};
    const std::uint32_t size = std::uint32_t(request.size), levels = std::uint32_t(std::bit_width(size));
    auto image = [&](VkFormat format, std::uint32_t mips, const char* name) {
        return recorder.image({.width = size,
                               .height = size,
                               .format = format,
                               .mips = mips,
                               .layers = std::uint32_t(cube.layers * faces),
                               .cube = true},
                              request.prefix + name);
    };
    cube.radiance = image(VK_FORMAT_R32G32B32A32_SFLOAT, levels, "cube radiance");
    cube.normal = image(VK_FORMAT_R16G16B16A16_SFLOAT, 1, "cube normal");
    cube.material = image(VK_FORMAT_R16G16B16A16_SFLOAT, 1, "cube material");
    cube.distance = image(VK_FORMAT_R32_SFLOAT, levels, "cube distance");
    if (request.min_max) cube.min_max = image(VK_FORMAT_R32G32_SFLOAT, levels, "cube min max");
    return cube;
}

// What each face of each layer sees, in the order of the images' layers.
std::vector<Capture> capture_faces(gpu::Recorder& recorder, const Frame& frame, const CubeRequest& request,
                                   float farthest) {
    std::vector<Capture> captures, lit;
    for (const CubeLayer& layer : request.layers)
        for (int face = 0; face < faces; ++face) {
            CaptureRequest c{.view = cube_face_view(layer.center.value_or(request.center), face, request.size,
                                                    farthest * near_by_far, farthest),
                             .prefix = request.prefix + "face ",
                             .sides = layer.sides,
                             .drawn = layer.drawn};
            LUXEL_ASSERT(!layer.behind || captures.size() >= faces, "layers={}", request.layers.size());
            if (layer.behind) c.farther_than = captures[captures.size() - faces].gbuffer.depth;
            captures.push_back(frame.capture_surfaces(recorder, c));
            if (layer.lit) lit.push_back(captures.back());
        }
    if (!lit.empty()) frame.add_light(recorder, lit);
    if (!lit.empty() && request.indirect) frame.add_indirect(recorder, lit);
    return captures;
}

void write_face(gpu::Recorder& recorder, const Frame& frame, const Capture& capture, CubeLight light,
                std::uint32_t layer, const DistanceCube& cube) {
    const Environment& environment = frame.scene->scene().environment;
    const bool sky = light == CubeLight::all && !environment.empty();
    shared::CubeFaceParams p{.face = int(layer) % faces,
                             .size = cube.size,
                             .background = cube.background,
                             .environment_rotation = environment.rotation,
                             .environment_scale = sky ? environment.scale : 0.0f};
    const GBuffer& g = capture.gbuffer;
    recorder.dispatch("common/cube_face.comp", extent_of(g.depth), p,
                      {{"depth", g.depth},
                       {"diffuse", g.diffuse},
                       {"specular", g.specular},
                       {"shading_normal", g.normal},
                       {"geometric_normal", g.geometric_normal},
                       {"direct", capture.direct},
                       {"light", light == CubeLight::all ? capture.direct : capture.direct_diffuse},
                       {"environment", frame.environment},
                       {"radiance", cube.radiance.mip(0).layer(layer)},
                       {"normal", cube.normal.layer(layer)},
                       {"material", cube.material.layer(layer)},
                       {"distance_from_center", cube.distance.mip(0).layer(layer)}});
}

// Level 0 holds each texel's distance twice; every other level the extremes of four texels of the one before.
void write_min_max(gpu::Recorder& recorder, const DistanceCube& cube) {
    const std::uint32_t layers = std::uint32_t(cube.layers * faces);
    for (int level = 0; cube.size >> level > 0; ++level) {
        const gpu::Image to = cube.min_max.mip(std::uint32_t(level));
        const gpu::Extent threads{to.width(), to.height(), layers};
        if (level == 0)
            recorder.dispatch("common/cube_min_max_first.comp", threads, gpu::Recorder::NoParams{},
                              {{"from", cube.distance.mip(0)}, {"to", to}});
        else
            recorder.dispatch("common/cube_min_max.comp", threads, gpu::Recorder::NoParams{},
                              {{"from", cube.min_max.mip(std::uint32_t(level) - 1)}, {"to", to}});
    }
}

gpu::Image layers_of(gpu::Image image, int first) {
    if (!image) return image;
    image.first_layer = std::uint32_t(first * faces), image.layer_count = faces;
    return image;
}

} // namespace

DistanceCube DistanceCube::layer(int index) const {
    LUXEL_ASSERT(index >= 0 && index < layers, "index={} layers={}", index, layers);
    DistanceCube one = *this;
    one.layers = 1;
    for (gpu::Image* image : {&one.radiance, &one.normal, &one.material, &one.distance, &one.min_max})
        *image = layers_of(*image, index);
    return one;
}

float farthest_corner(const Bounds& b, glm::vec3 from) {
    if (b.empty()) return 1.0f;
    return std::max(glm::length(glm::max(glm::abs(b.least - from), glm::abs(b.most - from))), 1e-3f);
}

shared::ViewParams cube_face_view(glm::vec3 center, int face, int size, float near, float far) {
    const shared::CubeAxes a = shared::cube_axes(face);
    return view_params({center, a.forward, -a.u, -a.v}, near, far, glm::vec2(float(size)));
}

DistanceCube capture_cube(gpu::Recorder& recorder, const Frame& frame, const CubeRequest& request) {
    auto scope = recorder.scope("cube");
    DistanceCube cube = make_images(recorder, request);
    float farthest = 0.0f;
    for (const CubeLayer& layer : request.layers)
        farthest = std::max(
            farthest, farthest_corner(frame.scene->bounds(), layer.center.value_or(request.center)) * 1.001f);
    cube.background = request.background > 0.0f ? request.background : 100.0f * farthest;

    std::vector<Capture> captures = capture_faces(recorder, frame, request, farthest);
    for (std::size_t i = 0; i < captures.size(); ++i)
        write_face(recorder, frame, captures[i], request.light, std::uint32_t(i), cube);
    recorder.generate_mips(cube.radiance);
    recorder.generate_mips(cube.distance);
    if (request.min_max) write_min_max(recorder, cube);
    return cube;
}

std::vector<CubeLayer> peeled_layers(const std::vector<bool>& drawn, int count, bool lit) {
    std::vector<CubeLayer> layers(std::size_t(count),
                                  {.drawn = drawn, .sides = Sides::all, .behind = true, .lit = lit});
    layers.at(0).behind = false;
    return layers;
}

std::vector<CubeLayer> face_layers(const std::vector<bool>& drawn, bool lit) {
    return {{.drawn = drawn, .sides = Sides::front, .lit = lit},
            {.drawn = drawn, .sides = Sides::back, .lit = lit}};
}

} // namespace luxel
