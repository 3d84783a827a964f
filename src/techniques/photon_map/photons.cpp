// SPDX-License-Identifier: MIT
// Photons from their first hits to the surfaces where they arrive.
#include <bit>

#include "shared/random.h"
#include "techniques/photon_map/photon_map.h"

namespace luxel {
namespace {

// Sums of flux over 4^l pixels; padded to a power of two, so that no pixel is left out.
gpu::Image flux_pyramid(gpu::Recorder& recorder, const RsmView& view, const gpu::Buffer& counts) {
    const std::uint32_t side = std::bit_ceil(std::max(view.seen.width, view.seen.height));
    const std::uint32_t levels = std::uint32_t(std::bit_width(side));
    gpu::Image sums = recorder.image({.width = side, .height = side, .mips = levels}, "photon flux");
    recorder.dispatch("photon_map/flux.comp", extent_of(sums), gpu::Recorder::NoParams{},
                      {{"flux", view.flux}, {"sums", sums.mip(0)}, {"counts", counts}});
    for (std::uint32_t level = 1; level < levels; ++level)
        recorder.dispatch("photon_map/flux_mip.comp", extent_of(sums.mip(level)),
                          shared::PhotonFluxParams{int(level)},
                          {{"from", sums.mip(level - 1)}, {"sums", sums.mip(level)}, {"counts", counts}});
    return sums;
}

constexpr std::uint32_t seed = 1; // the same photons in each frame [Le2014, 4]

} // namespace

PhotonBuffers emit_photons(gpu::Recorder& recorder, const std::vector<RsmView>& views, glm::vec3 center,
                           const PhotonOptions& options) {
    auto scope = recorder.scope("emit");
    gpu::Gpu& gpu = recorder.gpu();
    const int most = options.photons * (options.both ? 2 : 1);
    PhotonBuffers b{.photons = gpu.buffer(std::uint64_t(most) * sizeof(shared::Photon), "photons"),
                    .hits = gpu.buffer(std::uint64_t(most) * sizeof(shared::PhotonHit), "photon hits"),
                    .counts =
                        gpu.buffer(4 * (shared::PHOTON_LEVELS + shared::PHOTON_MAX_LEVELS), "photon counts"),
                    .most = most};
    recorder.fill(b.counts, 0);
    recorder.fill(b.photons, 0);
    std::vector<gpu::Image> pyramids;
    std::uint32_t levels = 1;
    for (const RsmView& view : views) {
        pyramids.push_back(flux_pyramid(recorder, view, b.counts));
        levels = std::max(levels, pyramids.back().info().mips);
    }

    // The level is chosen on the GPU, so that many of these threads have nothing to do.
    for (std::size_t i = 0; i < views.size(); ++i) {
        const RsmView& view = views[i];
        const GBuffer& g = view.seen.gbuffer;
        const shared::PhotonEmitParams p{.view = view.seen.view,
                                         .light = view.light,
                                         .center = center,
                                         .most = options.photons,
                                         .capacity = most,
                                         .levels = int(levels),
                                         .seed = shared::hash2(seed, shared::uint(i)),
                                         .both = options.both,
                                         .mixed = options.mixed};
        recorder.dispatch("photon_map/emit.comp", extent_of(pyramids[i]), p,
                          {{"sums", pyramids[i]},
                           {"depth", g.depth},
                           {"normal", g.normal},
                           {"geometric_normal", g.geometric_normal},
                           {"diffuse", g.diffuse},
                           {"specular", g.specular},
                           {"direct", view.seen.direct},
                           {"counts", b.counts},
                           {"photons", b.photons}});
    }
    return b;
}

void trace_photons(gpu::Recorder& recorder, const FragmentLists& lists, const PhotonBuffers& photons,
                   const PhotonOptions& options) {
    shared::PhotonTraceParams p{.view = lists.view(), .start = 0.01f, .most = photons.most};
    if (!options.skip) p.view.levels = 1;
    gpu::Bindings bindings = lists.bindings();
    for (const gpu::Binding& b : gpu::Bindings{{"min_max", lists.min_max()},
                                               {"photons", photons.photons},
                                               {"counts", photons.counts},
                                               {"hits", photons.hits}})
        bindings.push_back(b);
    recorder.dispatch("photon_map/march.comp", {std::uint32_t(photons.most)}, p, bindings);
}

void follow_photons(gpu::Recorder& recorder, const FragmentLists& lists, const PhotonBuffers& photons,
                    const PhotonOptions& options) {
    auto scope = recorder.scope("trace");
    for (int bounce = 1; bounce <= options.bounces; ++bounce) {
        trace_photons(recorder, lists, photons, options);
        const shared::PhotonScatterParams p{.center = lists.view().center,
                                            .last = bounce == options.bounces,
                                            .bounce = shared::uint(bounce),
                                            .seed = seed,
                                            .most = photons.most};
        recorder.dispatch("photon_map/scatter.comp", {std::uint32_t(photons.most)}, p,
                          {lists.bindings()[1],
                           {"shading", lists.shading()},
                           {"materials", lists.materials()},
                           {"photons", photons.photons},
                           {"counts", photons.counts},
                           {"hits", photons.hits}});
    }
}

} // namespace luxel
