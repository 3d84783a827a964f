// SPDX-License-Identifier: MIT
#include "techniques/containment/containment.h"

#include <cmath>

#include "techniques/common/point_sets.h"
#include "techniques/containment/containment_params.h"

namespace luxel {

void Containment::visit(Visitor& v) {
    options_.visit(v);
    v.choice("membership", membership_, occlusion_membership_names,
             "how an occluder's weight falls with distance");
}

std::vector<glm::vec3> containment_points(int samples, OcclusionMembership membership) {
    std::vector<glm::vec3> points = poisson_cylinder(samples);
    for (glm::vec3& p : points) {
        const float xi = p.z;
        float cosine = std::sqrt(1.0f - p.x * p.x - p.y * p.y), distance = 1.0f;
        switch (membership) { // distance = the inverse of the membership [Umenhoffer2009, 4.1.1]
        case OcclusionMembership::step:
            break;
        case OcclusionMembership::sqrt:
            distance = xi * xi;
            break;
        case OcclusionMembership::cubic:
            distance = std::cbrt(xi);
            break;
        case OcclusionMembership::tangent: {
            // Density cos^3 of the direction: cos^4 is uniform, where it is cos^2 for the disc's points.
            float squeezed = std::sqrt(cosine);
            float scale = std::sqrt((1.0f - squeezed * squeezed) / std::max(1.0f - cosine * cosine, 1e-12f));
            p.x *= scale, p.y *= scale;
            cosine = squeezed;
            distance = cosine * std::cbrt(xi);
            break;
        }
        case OcclusionMembership::exponential:
            distance = -std::log(1.0f - xi);
            break;
        }
        p = glm::vec3(p.x, p.y, cosine) * distance;
    }
    return points;
}

Contribution Containment::render(gpu::Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope("containment");
    gpu::Buffer taps = taps_.upload(recorder.gpu(), options_.samples, int(membership_),
                                    [&](int n) { return containment_points(n, membership_); });
    return {.accessibility = occlusion(recorder, frame, options_, "containment/gather.comp",
                                       shared::ContainmentParams{}, {{"taps", taps}})};
}

std::unique_ptr<Technique> make_containment() { return std::make_unique<Containment>(); }

} // namespace luxel
