// SPDX-License-Identifier: MIT
// Sampling of all that emits: triangles by what they would send to a point, the environment by importance,
// punctual lights by what they send.
#pragma once
#include <vector>

#include "reference/bsdf.h"
#include "reference/light_tree.h"
#include "scene/emission_map.h"
#include "scene/environment.h"
#include "scene/lights.h"

namespace luxel {

// Light that arrives at a surface from one drawn direction, if nothing is in the way.
struct LightArrival {
    glm::vec3 wi;       // unit, toward the light
    glm::vec3 target;   // where the shadow ray ends
    bool infinite;      // no target: the shadow ray has no end
    glm::vec3 radiance; // over the density: an estimate of radiance times solid angle
    float pdf;          // 1/sr for MIS with BSDF sampling; 0 for lights that BSDF sampling cannot meet
};

// From the surface to the light, ending before what sends it.
Ray shadow_ray(const ShadingPoint& point, const LightArrival& light);

class LightSampler {
public:
    explicit LightSampler(const Scene& scene);

    bool has_emitters() const { return !emitters_.empty(); }
    bool has_environment() const { return !environment_.empty(); }
    std::size_t punctual_count() const { return scene_->lights.size(); }

    // A point of an emissive triangle; u: chooses the triangle, v: the point. Radiance is 0 where nothing
    // faces `from`. normal: of the surface that is lit, zero: it is lit from everywhere.
    LightArrival sample_emitter(glm::vec3 from, glm::vec3 normal, float u, glm::vec2 v) const;
    LightArrival sample_environment(glm::vec2 u) const;
    LightArrival punctual(std::size_t light, glm::vec3 from) const;
    // Chances to choose among many punctual lights at a surface: cumulative, proportional to what each would
    // send to it unoccluded. False: none sends anything.
    bool choose_among(const ShadingPoint& point, std::vector<float>& cumulative) const;

    // Densities of the two samplers above for a direction that was found by BSDF sampling, 1/sr.
    float emitter_pdf(const Hit& hit, const Surface& surface, glm::vec3 from, glm::vec3 normal,
                      glm::vec3 wi) const;
    float environment_pdf(glm::vec3 wi) const { return environment_.pdf(wi); }

private:
    const Scene* scene_;
    EnvironmentSampler environment_;
    struct Emitter {
        EmissiveTriangle triangle;
        float clear; // see clearance()
        int map;     // of a textured one, drawn by texel; -1: none
        bool varies; // not the same everywhere: textured, or with holes
    };
    // A point of an emitter before it is known what it sends.
    struct Place {
        glm::vec2 uv;
        float pdf; // 1/sr from `from`
    };
    Place draw(const Emitter& e, glm::vec3 from, glm::vec2 v) const;
    // The same density of a point that is known.
    float pdf(const Emitter& e, glm::vec3 from, glm::vec3 point, glm::vec2 uv) const;

    std::vector<Emitter> emitters_;
    std::vector<EmissionMap> maps_;
    LightTree tree_;
    // Index of the emitter plus one, by instance and triangle; empty for instances that do not emit
    std::vector<std::vector<std::uint32_t>> emitter_of_;
};

// Index of the element that `u` in [0, 1) falls on.
std::size_t find_in(const std::vector<float>& cumulative, float u);

} // namespace luxel
