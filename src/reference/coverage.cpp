// SPDX-License-Identifier: MIT
#include "reference/coverage.h"

#include "reference/bsdf.h"

namespace luxel {

void go_behind(Ray& ray, const Hit& hit, const Surface& surface) {
    ray.origin = ShadingPoint(surface, ray.direction).origin(ray.direction);
    ray.t_max -= hit.t;
    ray.t_min = 0.0f;
}

bool intersect_covered(const RayCaster& rays, Ray& ray, Hit& hit, Random& random, float& passed,
                       bool by_camera) {
    passed = 0.0f;
    while (by_camera ? rays.intersect_seen(ray, hit) : rays.intersect(ray, hit)) {
        const float coverage = coverage_at(rays.scene(), hit.instance, hit.triangle, {hit.u, hit.v});
        if (coverage >= 1.0f || random.next() < coverage) return true;
        go_behind(ray, hit, surface_at(rays.scene(), hit, ray.direction));
        passed += hit.t;
    }
    return false;
}

} // namespace luxel
