// SPDX-License-Identifier: MIT
// What the techniques of the occlusion slot have in common: they darken ambient light, and nothing else.
#pragma once
#include "techniques/common/occlusion.h"
#include "techniques/technique.h"

namespace luxel {

class OcclusionTechnique : public Technique {
public:
    Slot slot() const override { return Slot::occlusion; }
    std::vector<std::string> components() const override { return {"ao"}; }
    std::vector<Need> needs(const Scene& scene, const FrameOptions& frame) const override {
        return {{"an environment as ambient light (--frame environment=ambient)",
                 has_ambient_light(scene, frame)}};
    }
};

} // namespace luxel
