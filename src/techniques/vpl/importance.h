// SPDX-License-Identifier: MIT
// Lights drawn by what they send to the camera's view [Ritschel2011].
#pragma once
#include "techniques/common/vpl.h"
#include "techniques/vpl/ism.h"

namespace luxel {

struct VplImportanceOptions {
    int points = 64;     // visible points that are asked; 0: lights are drawn by flux alone
    int candidates = 16; // for each light that is drawn
    void visit(Visitor& v);
};

// About `wanted` of the candidates, those that light what the frame sees more often, each with the flux that
// it stands for. points: for visibility between candidates and what is seen; none: whatever lies between.
Vpls resample_vpls(gpu::Recorder& recorder, const Frame& frame, const Vpls& candidates, int wanted,
                   const VplImportanceOptions& options, const IsmPoints* points);

} // namespace luxel
