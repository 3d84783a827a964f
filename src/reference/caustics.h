// SPDX-License-Identifier: MIT
// Caustics by progressive photon mapping: stochastic progressive photon mapping [Hachisuka2009] in the form
// without memory [Knaus2011], in which each pass is an independent estimate with a radius of its own, and
// their mean converges. So a pass is one sample of every pixel, and groups, variance and checkpoints are
// those of paths.
#pragma once
#include <functional>

#include "reference/photon_tracer.h"

namespace luxel {

class CausticTracer {
public:
    // Keeps a reference to `rays`.
    CausticTracer(const RayCaster& rays, const ReferenceRequest& request);
    CausticTracer(const CausticTracer&) = delete;
    CausticTracer& operator=(const CausticTracer&) = delete;

    // sink(x, y, caustics, bias) for every pixel, from several threads, each pixel once. The same numbers for
    // the same pass, whatever came before.
    using Sink = std::function<void(int x, int y, glm::vec3 caustics, glm::vec3 bias)>;
    void trace_pass(int pass, const Sink& sink) const;

private:
    bool may_be_seen(glm::vec3 position) const;
    void gather(const PhotonMap& map, int pass, int x, int y, const Sink& sink) const;

    const RayCaster* rays_;
    ReferenceSettings settings_;
    CameraBasis camera_;
    float near_, far_;
    int width_, height_;
    float pixel_; // its side, at distance 1 or everywhere (orthographic)
    float seen_;  // half extents of the image plus the largest radius, in half extents of the image
    PhotonTracer photons_;
};

} // namespace luxel
