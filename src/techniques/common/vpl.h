// SPDX-License-Identifier: MIT
// Virtual point lights of a frame: a few pixels of its reflective shadow maps [Keller1997] [Dachsbacher2005].
#pragma once
#include <vector>

#include "techniques/common/rsm.h"
#include "techniques/common/vpl_params.h"

namespace luxel {

enum class VplPattern { even, grid }; // the values of VPL_*

struct VplOptions {
    int count = 1024; // of the whole frame
    VplPattern pattern = VplPattern::even;
    void visit(Visitor& v);
};

struct Vpls {
    gpu::Buffer lights; // VPL_TEXELS RGBA32F texels each; the first `count` send light
    gpu::Buffer count;  // int
    int most = 0;       // that `count` can be
};

// How many of `count` lights each view gets: by the flux that its light sends into it, at least one where
// that is not 0. For VplPattern::grid the nearest square.
std::vector<int> vpl_shares(const std::vector<RsmView>& views, const VplOptions& options);

// Each light stands for as many pixels of its view as any other; of a spot's image only the circle counts.
Vpls sample_vpls(gpu::Recorder& recorder, const std::vector<RsmView>& views, const VplOptions& options);

} // namespace luxel
