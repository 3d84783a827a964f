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

constexpr std::uint32_t seed = 1;         // the same photons in each frame [Le2014, 4]
constexpr std::uint32_t most_rows = 4096; // of the image of lines
constexpr float start = 0.01f;            // pixels before which a ray meets nothing

} // namespace

PhotonBuffers emit_photons(gpu::Recorder& recorder, const std::vector<RsmView>& views, glm::vec3 center,
                           const PhotonOptions& options) {
    auto scope = recorder.scope("emit");
    gpu::Gpu& gpu = recorder.gpu();
    // Every view sends one photon at least, whatever level the others are at.
    const int cells = options.photons + int(views.size()), most = cells * (options.both ? 2 : 1);
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

    for (std::size_t i = 0; i < views.size(); ++i) {
        const RsmView& view = views[i];
        const gpu::Buffer picked =
            gpu.buffer(sizeof(shared::PickedCells) + 4 * std::uint64_t(cells), "photon cells");
        recorder.fill(picked, 1);
        recorder.dispatch("photon_map/pick.comp", extent_of(pyramids[i]),
                          shared::PhotonPickParams{options.photons, int(levels), options.mixed},
                          {{"sums", pyramids[i]}, {"counts", b.counts}, {"picked", picked}});
        const GBuffer& g = view.seen.gbuffer;
        const shared::PhotonEmitParams p{.view = view.seen.view,
                                         .light = view.light,
                                         .center = center,
                                         .capacity = most,
                                         .seed = shared::hash2(seed, shared::uint(i)),
                                         .differential = options.disc == PhotonDisc::differential,
                                         .both = options.both};
        recorder.dispatch_indirect("photon_map/emit.comp", picked, 0, p,
                                   {{"sums", pyramids[i]},
                                    {"depth", g.depth},
                                    {"normal", g.normal},
                                    {"geometric_normal", g.geometric_normal},
                                    {"diffuse", g.diffuse},
                                    {"specular", g.specular},
                                    {"direct", view.seen.direct},
                                    {"picked", picked},
                                    {"counts", b.counts},
                                    {"photons", b.photons}});
    }
    return b;
}

namespace {

// What photon_map/rays.glsl and the tracers declare.
gpu::Bindings ray_bindings(const FragmentLists& lists, const PhotonBuffers& photons) {
    gpu::Bindings bindings = lists.bindings();
    bindings.push_back({"photons", photons.photons});
    bindings.push_back({"counts", photons.counts});
    return bindings;
}

// So many rays at a time as rows of one image, and the first hit of each row.
void trace_lines(gpu::Recorder& recorder, const FragmentLists& lists, const PhotonBuffers& photons,
                 shared::PhotonTraceParams p) {
    const std::uint32_t width = std::uint32_t(lists.view().side) + 1;
    const std::uint32_t rows = std::min(std::uint32_t(photons.most), most_rows);
    const gpu::Image met =
        recorder.image({.width = width, .height = rows, .format = VK_FORMAT_R32G32_SFLOAT}, "photon lines");
    gpu::Bindings drawn = ray_bindings(lists, photons), first = ray_bindings(lists, photons);
    drawn.push_back({"min_max", lists.min_max()});
    first.push_back({"met", met});
    first.push_back({"hits", photons.hits});
    p.rows = int(rows);
    const gpu::RasterPass pass{.color = {{met, std::array<float, 4>{1e30f, -1.0f, 0, 0}}},
                               .topology = VK_PRIMITIVE_TOPOLOGY_LINE_LIST};
    const std::vector<gpu::Batch> all = {{.draws = {{.count = 2 * rows}}}};
    for (p.first_row = 0; p.first_row < photons.most; p.first_row += int(rows)) {
        recorder.draw("photon_map/lines", pass, p, drawn, {}, all);
        recorder.dispatch("photon_map/lines_first.comp", {rows}, p, first);
    }
}

} // namespace

void trace_photons(gpu::Recorder& recorder, const FragmentLists& lists, const PhotonBuffers& photons,
                   const PhotonOptions& options) {
    shared::PhotonTraceParams p{.view = lists.view(), .start = start, .most = photons.most};
    if (options.tracer == PhotonTracer::lines) return trace_lines(recorder, lists, photons, p);
    if (!options.skip) p.view.levels = 1;
    gpu::Bindings bindings = ray_bindings(lists, photons);
    bindings.push_back({"min_max", lists.min_max()});
    bindings.push_back({"hits", photons.hits});
    recorder.dispatch("photon_map/march.comp", {std::uint32_t(photons.most)}, p, bindings);
}

void follow_photons(gpu::Recorder& recorder, const FragmentLists& lists, const PhotonBuffers& photons,
                    const PhotonOptions& options) {
    auto scope = recorder.scope("trace");
    for (int bounce = 1; bounce <= options.bounces; ++bounce) {
        trace_photons(recorder, lists, photons, options);
        const shared::PhotonScatterParams p{.view = lists.view(),
                                            .last = bounce == options.bounces,
                                            .bounce = shared::uint(bounce),
                                            .seed = seed,
                                            .most = photons.most};
        recorder.dispatch("photon_map/scatter.comp", {std::uint32_t(photons.most)}, p,
                          {lists.bindings()[0],
                           lists.bindings()[1],
                           {"shading", lists.shading()},
                           {"materials", lists.materials()},
                           {"photons", photons.photons},
                           {"counts", photons.counts},
                           {"hits", photons.hits}});
    }
}

} // namespace luxel
