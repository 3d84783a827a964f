// SPDX-License-Identifier: MIT
// Ray queries against a scene, the only place that knows Embree. Alpha-masked texels are not hit.
#pragma once
#include <cstdint>
#include <memory>

#include "scene/scene.h"

namespace luxel {

struct ShadingMesh;

struct Ray {
    glm::vec3 origin, direction; // direction need not be unit; t is in its length
    float t_min = 0.0f, t_max = 1e30f;
};

struct Hit {
    float t;
    std::uint32_t instance;               // index into Scene::instances
    std::uint32_t triangle;               // within the instance's mesh
    float u, v;                           // barycentric weights of vertices 1 and 2
    glm::vec3 geometric_normal;           // world, not normalized, by the triangle's winding
    const ShadingMesh* shading = nullptr; // the instance's, for surface_at(); may be absent
};

class RayCaster {
public:
    // Builds the acceleration structure; keeps a pointer to `scene`, which must outlive it unmoved.
    explicit RayCaster(const Scene& scene);
    ~RayCaster();
    RayCaster(RayCaster&&) noexcept;
    RayCaster& operator=(RayCaster&&) noexcept;

    bool intersect(const Ray& ray, Hit& hit) const; // nearest hit
    // The same for a camera, which looks through the backs that Material::looks_through_back says.
    bool intersect_seen(const Ray& ray, Hit& hit) const;
    bool occluded(const Ray& ray) const; // any hit
    // Share of the light that gets along the ray: nothing where something solid is in the way, otherwise what
    // the thin sheets on it let straight through (thin_sheets.h).
    glm::vec3 transmitted(const Ray& ray) const;
    const Scene& scene() const;
    void* embree_scene() const; // RTCScene, for the benchmark that compares with bare queries

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace luxel
