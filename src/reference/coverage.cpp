// SPDX-License-Identifier: MIT
#include "reference/coverage.h"

#include <algorithm>

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

bool has_blended(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [](const Material& m) { return m.alpha_mode == AlphaMode::blend; });
}

float uncovered(const RayCaster& rays, const Ray& ray) {
    float share = 1.0f;
    Ray rest = ray;
    Hit hit;
    while (share > 0.0f && rays.intersect(rest, hit)) {
        const Scene& scene = rays.scene();
        const Mesh& mesh = scene.meshes[std::size_t(scene.instances[hit.instance].mesh)];
        if (scene.materials[std::size_t(mesh.material)].alpha_mode == AlphaMode::blend)
            share *= 1.0f - coverage_at(scene, hit.instance, hit.triangle, {hit.u, hit.v});
        go_behind(rest, hit, surface_at(scene, hit, ray.direction));
        if (rest.t_max <= 0.0f) break;
    }
    return share;
}

} // namespace luxel
