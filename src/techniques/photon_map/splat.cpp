// SPDX-License-Identifier: MIT
// Photons as discs on the frame [Le2014, 3.3.2.3 and 3.3.2.4].
#include <cmath>

#include "techniques/photon_map/photon_map.h"

namespace luxel {
namespace {

// A cone of this radius in pixels keeps its energy within 2 %, wherever its middle lies on their grid.
constexpr float least_radius = 2.0f;
// With it the Gaussian spreads light as far as the cone does: their second moments over the disc are 2 delta
// h^2 (but for its end) and 3/10 h^2.
constexpr float delta = 0.15f;

} // namespace

gpu::Image photon_irradiance(gpu::Recorder& recorder, const Capture& seen, const PhotonBuffers& photons,
                             glm::vec3 center, const PhotonOptions& options) {
    auto scope = recorder.scope("splat");
    const std::uint32_t step = std::uint32_t(options.scale);
    const gpu::ImageInfo size{.width = (seen.width + step - 1) / step,
                              .height = (seen.height + step - 1) / step};
    const gpu::Image guide = recorder.image(size, "photon guide");
    const GBuffer& g = seen.gbuffer;
    recorder.dispatch("photon_map/guide.comp", extent_of(guide), options.scale,
                      {{"depth", g.depth}, {"geometric_normal", g.geometric_normal}, {"guide", guide}});

    // Tents reach the next photon, where it is known.
    const bool tent = options.kernel == PhotonKernel::tent;
    const float reach = std::sqrt(options.share / shared::PI);
    // Coarse pixels are pixels of the view; their view is the same, cut into fewer.
    shared::PhotonSplatParams p{.view = seen.view,
                                .center = center,
                                .reach = tent ? 1.0f : reach,
                                .reach_beam = reach,
                                .least = tent ? 1.0f : least_radius,
                                .most_radius = 0.25f * seen.scene->bounds().radius(),
                                .delta = delta,
                                .shift = (std::floor(float(step) / 2) + 0.5f) / float(step) - 0.5f};
    p.frame_size = {p.view.width, p.view.height};
    p.view.width /= float(step), p.view.height /= float(step);
    p.share = {p.view.width / float(size.width), p.view.height / float(size.height)};
    const gpu::Image sum = recorder.image(size, "photon splats");
    const gpu::RasterPass pass{.color = {{sum, std::array<float, 4>{}, gpu::Blend::add}}};
    const std::vector<gpu::Batch> all = {{.draws = {{.count = std::uint32_t(6 * photons.most)}}}};
    recorder.draw("photon_map/splat_" + photon_kernels[std::size_t(options.kernel)], pass, p,
                  {{"photons", photons.photons}, {"counts", photons.counts}, {"guide", guide}}, {}, all);
    if (step == 1) return sum;

    const gpu::Image full = recorder.image({.width = seen.width, .height = seen.height}, "photon irradiance");
    recorder.dispatch("photon_map/upsample.comp", extent_of(full), options.scale,
                      {{"coarse", sum},
                       {"guide", guide},
                       {"depth", g.depth},
                       {"geometric_normal", g.geometric_normal},
                       {"irradiance", full}});
    return full;
}

} // namespace luxel
