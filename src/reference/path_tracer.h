// SPDX-License-Identifier: MIT
// One camera path at a time, split into the components of reference.h.
#pragma once
#include <vector>

#include "reference/light_sampler.h"
#include "reference/reference.h"

namespace luxel {

// Radiance of one path, by component.
struct PathSample {
    glm::vec3 direct{0.0f}, diffuse1{0.0f}, diffuse1_unoccluded{0.0f}, diffuse{0.0f}, specular{0.0f};
    float ao = 0.0f;
    glm::vec3 full() const { return direct + diffuse + specular; }
};

// What to compute; paths end where nothing asked for can follow.
struct WantedComponents {
    bool direct = false, diffuse1 = false, diffuse1_unoccluded = false, diffuse = false, specular = false,
         ao = false;
    explicit WantedComponents(
        const std::vector<std::string>& names); // `full` is direct, diffuse and specular
};

// Tests hold the strategies against each other: their means must agree.
enum class Strategy { mis, lights_only, bsdf_only };

// The rays of a run in their order, for the benchmark that replays them.
struct RayLog {
    struct Entry {
        Ray ray;
        bool shadow;
    };
    std::vector<Entry> entries;
};

struct PathTracerOptions {
    Strategy strategy = Strategy::mis;
    RayLog* log = nullptr; // one thread only
};

class PathTracer {
public:
    // Keeps references to `rays` and its scene.
    PathTracer(const RayCaster& rays, const ReferenceRequest& request, const PathTracerOptions& options = {});

    PathSample trace(int x, int y, int sample) const;
    bool sees_surface(int x, int y) const; // through the pixel's center

private:
    struct Path;
    Ray camera_ray(glm::vec2 pixel) const;
    bool intersect(const Ray& ray, Hit& hit) const;
    bool occluded(const ShadingPoint& point, const LightArrival& light) const;

    // Light from all sources (of the emitters, one that was chosen) that reaches `point` and is reflected to
    // where its ray came from.
    BsdfValue direct_light(const ShadingPoint& point, std::size_t emitter, bool first, Random& random) const;
    void add_arrival(const ShadingPoint& point, const LightArrival& light, BsdfValue& sum) const;
    void add_punctual(const ShadingPoint& point, bool first, Random& random, BsdfValue& sum) const;
    // Emission met by a ray that was drawn with density bsdf_pdf, with its MIS weight.
    glm::vec3 environment_met(glm::vec3 wi, float bsdf_pdf) const;
    glm::vec3 emission_met(const Hit& hit, const Surface& surface, glm::vec3 from, glm::vec3 wi,
                           float bsdf_pdf) const;

    void follow(Path& path) const;
    bool scatter(Path& path, const ShadingPoint& point) const;
    bool is_wanted(const Path& path) const;
    bool more_is_wanted(const Path& path) const;
    float openness(const ShadingPoint& point, Random& random) const;
    glm::vec3 unoccluded_bounce(const ShadingPoint& point, Random& random) const;
    glm::vec3 diffuse_reflection(const Surface& surface, glm::vec3 direction, Random& random) const;

    const RayCaster* rays_;
    const Scene* scene_;
    ReferenceSettings settings_;
    WantedComponents wanted_;
    PathTracerOptions options_;
    LightSampler lights_;
    CameraBasis camera_;
    float near_, far_;
    int width_, height_;
};

} // namespace luxel
