// SPDX-License-Identifier: MIT
// Ambient occlusion by containment tests [Umenhoffer2009, 4.1.1]: points of the neighborhood are inside or
// outside of what the depth buffer shows.
#pragma once
#include "techniques/common/occlusion_technique.h"

namespace luxel {

class Containment final : public OcclusionTechnique {
public:
    void visit(Visitor& v) override;
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override;

private:
    OcclusionOptions options_;
    OcclusionMembership membership_ = OcclusionMembership::step;
    TapTable taps_;
};

// Points with density cos/pi in direction and the membership's derivative in distance, in radii; z along the
// normal.
std::vector<glm::vec3> containment_points(int samples, OcclusionMembership membership);

} // namespace luxel
