// SPDX-License-Identifier: MIT
#include "techniques/envmap/probes.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/error.h"

namespace luxel {

using gpu::Recorder;

void check_envmap_options(const EnvmapOptions& o) {
    if (!std::has_single_bit(unsigned(o.texels)) || !std::has_single_bit(unsigned(o.size)) ||
        o.texels > o.size)
        fail(Fault::usage, "envmap: texels={} and size={} must be powers of two, texels the smaller",
             o.texels, o.size);
    if (o.glossy && o.probes == EnvmapProbes::grid)
        fail(Fault::usage, "envmap: glossy=on needs a probe for each object, probes=objects");
}

std::vector<CubeLayer> object_probes(const GpuScene& scene, const std::vector<SceneObject>& objects) {
    std::vector<CubeLayer> probes;
    for (const SceneObject& object : objects)
        probes.push_back({.drawn = all_but(scene.scene(), {object}),
                          .center = scene.bounds_of(object.instances).center()});
    return probes;
}

std::vector<CubeLayer> grid_probes(const Bounds& bounds, int longest, shared::EnvmapGatherParams& p) {
    const glm::vec3 size = glm::max(bounds.most - bounds.least, glm::vec3(1e-3f));
    const float cell = std::max({size.x, size.y, size.z}) / float(longest);
    std::vector<CubeLayer> probes;
    p.grid = glm::max(glm::ivec3(glm::round(size / cell)), glm::ivec3(1));
    p.grid_step = size / glm::vec3(p.grid);
    p.grid_least = bounds.least + 0.5f * p.grid_step;
    for (int i = 0; i < p.grid.x * p.grid.y * p.grid.z; ++i)
        probes.push_back({.center = shared::envmap_position(p, i)});
    return probes;
}

namespace {

std::uint32_t level_of(const DistanceCube& cube, int side) {
    return std::uint32_t(std::countr_zero(unsigned(cube.size)) - std::countr_zero(unsigned(side)));
}

gpu::Buffer list_senders(Recorder& recorder, const DistanceCube& cube, const std::vector<CubeLayer>& probes,
                         const EnvmapOptions& options) {
    const bool quads = options.estimator == EnvmapEstimator::polygon;
    const std::uint32_t senders = std::uint32_t(6 * options.texels * options.texels);
    const std::uint64_t elements =
        std::uint64_t(quads ? shared::ENVMAP_QUAD : shared::ENVMAP_POINT) * senders * probes.size();
    gpu::Buffer list = recorder.gpu().buffer(elements * sizeof(glm::vec4), "envmap senders");
    shared::EnvmapListParams p{.texels = options.texels,
                               .level = float(level_of(cube, options.texels)),
                               .corners = options.radiance == EnvmapRadiance::corners ? 1.0f : 0.0f};
    p.distance_level = options.corner == EnvmapCorner::exact ? 0.0f : p.level;
    for (std::size_t i = 0; i < probes.size(); ++i) {
        p.center = *probes[i].center, p.probe = int(i);
        const DistanceCube one = cube.layer(int(i));
        recorder.dispatch(quads ? "envmap/quads.comp" : "envmap/points.comp", {senders}, p,
                          {{"radiance", one.radiance, gpu::Sampler::linear_clamp},
                           {"distance_from_center", one.distance, gpu::Sampler::linear_clamp},
                           {"list", list}});
    }
    return list;
}

gpu::Image convolve(Recorder& recorder, const DistanceCube& cube) {
    const std::uint32_t side = shared::ENVMAP_CONVOLVED;
    gpu::Image convolved = recorder.image(
        {.width = side, .height = side, .layers = std::uint32_t(6 * cube.layers), .cube = true},
        "envmap convolved");
    const std::uint32_t level = level_of(cube, std::min(cube.size, int(side)));
    for (int i = 0; i < cube.layers; ++i) {
        gpu::Image faces = convolved;
        faces.first_layer = std::uint32_t(6 * i), faces.layer_count = 6;
        recorder.dispatch("envmap/convolve.comp", {side, side, 6}, Recorder::NoParams{},
                          {{"radiance", cube.layer(i).radiance.mip(level)}, {"irradiance", faces}});
    }
    return convolved;
}

gpu::Image prefilter(Recorder& recorder, const DistanceCube& cube) {
    gpu::Image prefiltered = recorder.image({.width = std::uint32_t(shared::ENVMAP_GLOSSY),
                                             .height = std::uint32_t(shared::ENVMAP_GLOSSY),
                                             .mips = std::uint32_t(shared::ENVMAP_GLOSSY_LEVELS),
                                             .layers = std::uint32_t(6 * cube.layers),
                                             .cube = true},
                                            "envmap prefiltered");
    for (int i = 0; i < cube.layers; ++i)
        for (int level = 0; level < shared::ENVMAP_GLOSSY_LEVELS; ++level) {
            gpu::Image faces = prefiltered.mip(std::uint32_t(level));
            faces.first_layer = std::uint32_t(6 * i), faces.layer_count = 6;
            const shared::EnvmapPrefilterParams p{cube.size,
                                                  float(level) / float(shared::ENVMAP_GLOSSY_LEVELS - 1)};
            recorder.dispatch(
                "envmap/prefilter.comp", {faces.width(), faces.height(), 6}, p,
                {{"radiance", cube.layer(i).radiance, gpu::Sampler::linear_clamp}, {"prefiltered", faces}});
        }
    return prefiltered;
}

} // namespace

gpu::Image tabulate_reflectance(gpu::Gpu& gpu) {
    const std::uint32_t side = std::uint32_t(shared::ENVMAP_REFLECTANCE);
    gpu::Image table =
        gpu.image({.width = side, .height = side, .format = VK_FORMAT_R32G32_SFLOAT}, "envmap reflectance");
    Recorder recorder(gpu);
    recorder.dispatch("envmap/reflectance.comp", extent_of(table), Recorder::NoParams{},
                      {{"reflectance", table}});
    recorder.submit();
    return table;
}

EnvmapSenders find_senders(Recorder& recorder, const Frame& frame, const std::vector<CubeLayer>& probes,
                           const EnvmapOptions& options) {
    DistanceCube cube =
        capture_cube(recorder, frame,
                     {.size = options.size,
                      .layers = probes,
                      .light = options.light == EnvmapLight::all ? CubeLight::all : CubeLight::diffuse,
                      .prefix = "envmap "});
    EnvmapSenders senders{.distance = cube.distance.mip(0)};
    if (options.estimator == EnvmapEstimator::classic)
        senders.convolved = convolve(recorder, cube);
    else
        senders.list = list_senders(recorder, cube, probes, options);
    if (options.glossy) senders.prefiltered = prefilter(recorder, cube);
    return senders;
}

} // namespace luxel
