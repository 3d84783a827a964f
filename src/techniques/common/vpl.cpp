// SPDX-License-Identifier: MIT
#include "techniques/common/vpl.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/image.h"
#include "techniques/common/rsm_params.h"
#include "techniques/frame/shadow_maps.h"

namespace luxel {

void VplOptions::visit(Visitor& v) {
    v.integer("vpls", count, {1, 65536}, "virtual point lights of the frame, shared out by flux");
    v.choice(
        "pattern", pattern, {"even", "grid"},
        "pixels of the reflective shadow maps: low discrepancy, or one at random in each cell of a grid");
}

namespace {

// Flux that a light sends into a view, whatever is there: by a coarse image of it, at distance 1.
double flux_into(const RsmView& view) {
    constexpr int side = 16;
    shared::RsmParams p{view.seen.view, view.light};
    p.view.width = p.view.height = float(side);
    p.light.range = 0.0f;
    double sum = 0.0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const glm::vec2 pixel = glm::vec2(x, y) + 0.5f;
            sum += double(
                luminance(shared::incident_flux(p, pixel, shared::world_position(p.view, pixel, 1.0f))));
        }
    return sum;
}

// Views of a spot's cone: what lies outside of the circle is dark.
bool is_disc(const RsmView& view) {
    return view.light.type == shared::LIGHT_SPOT && shadow_map_count(view.light) == 1;
}

int nearest_square(int count) {
    const int n = std::max(int(std::lround(std::sqrt(double(count)))), 1);
    return n * n;
}

} // namespace

std::vector<int> vpl_shares(const std::vector<RsmView>& views, const VplOptions& options) {
    std::vector<double> flux;
    for (const RsmView& view : views) flux.push_back(flux_into(view));
    const double all = std::accumulate(flux.begin(), flux.end(), 0.0);
    std::vector<int> shares;
    for (double f : flux) {
        int share = f > 0.0 ? std::max(int(std::lround(f / all * options.count)), 1) : 0;
        if (options.pattern == VplPattern::grid && share > 0) share = nearest_square(share);
        shares.push_back(share);
    }
    return shares;
}

Vpls sample_vpls(gpu::Recorder& recorder, const std::vector<RsmView>& views, const VplOptions& options) {
    auto scope = recorder.scope("vpls");
    const std::vector<int> shares = vpl_shares(views, options);
    Vpls vpls{.most = std::accumulate(shares.begin(), shares.end(), 0)};
    const std::uint64_t bytes =
        std::uint64_t(std::max(vpls.most, 1)) * shared::VPL_TEXELS * sizeof(glm::vec4);
    const gpu::Buffer candidates = recorder.gpu().buffer(bytes, "vpl candidates");
    vpls.lights = recorder.gpu().buffer(bytes, "vpls");
    vpls.count = recorder.gpu().buffer(sizeof(int), "vpl count");
    if (vpls.most == 0) {
        recorder.fill(vpls.lights, 0), recorder.fill(vpls.count, 0);
        return vpls;
    }

    int first = 0;
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (shares[i] == 0) continue;
        const RsmView& view = views[i];
        // Every view has its own shift, so that the faces of many lights do not repeat one pattern.
        const shared::VplSampleParams p{.view = view.seen.view,
                                        .light = view.light,
                                        .first = first,
                                        .count = shares[i],
                                        .pattern = shared::uint(options.pattern),
                                        .disc = is_disc(view) ? 1u : 0u,
                                        .shift = glm::fract(float(i) * glm::vec2(0.75487766f, 0.56984029f))};
        recorder.dispatch("common/vpl_sample.comp", {std::uint32_t(shares[i])}, p,
                          {{"depth", view.seen.gbuffer.depth},
                           {"normal", view.seen.gbuffer.normal},
                           {"geometric_normal", view.seen.gbuffer.geometric_normal},
                           {"reflected", view.reflected},
                           {"candidates", candidates}});
        first += shares[i];
    }
    recorder.dispatch("common/vpl_compact.comp", {}, shared::VplCompactParams{vpls.most},
                      {{"candidates", candidates}, {"lights", vpls.lights}, {"light_count", vpls.count}});
    return vpls;
}

} // namespace luxel
