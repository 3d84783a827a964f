// SPDX-License-Identifier: MIT
// One camera path at a time, split into the components of reference.h.
#pragma once
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "reference/light_sampler.h"
#include "reference/media.h"
#include "reference/photon_tracer.h"
#include "reference/reference.h"

namespace luxel {

// Radiance of one path, by component.
struct PathSample {
    glm::vec3 direct{0.0f}, diffuse1{0.0f}, diffuse1_unoccluded{0.0f}, diffuse{0.0f}, specular{0.0f},
        reflections{0.0f}, caustics{0.0f}, photon_bias{0.0f};
    float ao = 0.0f;
    glm::vec3 full() const { return direct + diffuse + specular; }
};

// What to compute; paths end where nothing asked for can follow.
struct WantedComponents {
    bool direct = false, diffuse1 = false, diffuse1_unoccluded = false, diffuse = false, specular = false,
         reflections = false, caustics = false, ao = false;
    // `full` is direct, diffuse and specular; caustics may be left to photons.
    WantedComponents(const std::vector<std::string>& names, CausticMethod caustic_method);
    bool specular_lobes() const { return specular || reflections || caustics; }
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

// Light that the lights would send to a surface, before visibility.
struct LightSamples {
    struct Sample {
        LightArrival light;
        BsdfValue reflected; // MIS weight included
    };
    std::array<Sample, 6> samples; // at most first_draws punctual ones, an emitter, the environment
    std::size_t count = 0;
};

// What all paths through the same point of the image share.
struct FirstVertex {
    Hit hit{};
    bool found = false;
    Surface surface{};
    bool lit_by_all = false; // `lit` holds what the surface reflects of all punctual lights
    BsdfValue lit;
};

// The surface at which light samples compete with a ray.
struct Sender {
    glm::vec3 position{0.0f}, normal{0.0f};
};

// The state of one camera path.
struct Path {
    Random random;
    const FirstVertex* first = nullptr; // known beforehand
    Ray ray{};
    Sender from; // the surface that sent it, or the camera
    bool alive = true;
    Hit hit{};          // of the ray,
    bool found = false; // if it meets a surface
    PathSample result;
    int vertex = 0;                      // surfaces met so far
    glm::vec3 beta{1.0f};                // throughput of all lobes
    glm::vec3 diffuse{1.0f};             // throughput if every vertex so far reflected by its Lambertian lobe
    glm::vec3 reflected{1.0f};           // throughput if all vertices so far had been specular (see bsdf.h)
    glm::vec3 reflected_smooth{0.0f};    // the same, but all smooth lobes of the last one
    glm::vec3 caustic{1.0f};             // throughput if the first was Lambertian, all others specular
    bool ideal = false;                  // the lobe that sent the present ray
    bool after_smooth = false;           // a smooth lobe sent an earlier one, or this one
    const PhotonPass* photons = nullptr; // of this sample, where there are any
    Media media;                         // that the path is inside of
    float length = 0.0f;                 // of the way from the camera, as far as pixels grow with it
    float pdf = 0.0f;                    // of the present ray, where the lobe was smooth

    // Light that the last of `vertex` surfaces sends along the path: `all` lobes of it, `lambert` its diffuse
    // part, the throughputs of what lies before included; `by_ideal_lobe`: of mirror or glass.
    void add(glm::vec3 all, glm::vec3 lambert, bool by_ideal_lobe) {
        if (vertex == 0 || (vertex == 1 && !by_ideal_lobe)) {
            result.direct += all;
            return;
        }
        result.diffuse += lambert;
        if (vertex == 2) result.diffuse1 += lambert;
        result.specular += all - lambert;
    }
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

    // sink(sample, PathSample) for `count` samples of a pixel from `first` on, in order; with a pass of
    // photons for each sample, or none.
    template <class Sink> void trace_samples(int x, int y, int first, int count,
                                             std::span<const PhotonPass> photons, Sink&& sink) const {
        std::optional<FirstVertex> shared;
        if (settings_.pixel_center) shared = first_vertex(x, y);
        std::vector<Path> paths;
        paths.reserve(paths_side_by_side);
        for (int done = 0; done < count; done += int(paths.size())) {
            paths.clear();
            for (int i = done; i < std::min(count, done + paths_side_by_side); ++i)
                paths.push_back(start(x, y, first + i, shared ? &*shared : nullptr,
                                      photons.empty() ? nullptr : &photons[std::size_t(i)]));
            follow(paths);
            for (std::size_t i = 0; i < paths.size(); ++i) sink(first + done + int(i), paths[i].result);
        }
    }

private:
    Ray camera_ray(glm::vec2 pixel) const;
    bool intersect(const Ray& ray, Hit& hit) const;
    bool intersect_seen(const Ray& ray, Hit& hit) const; // of rays from the camera
    // Share of the light that gets to the point, straight through thin sheets.
    glm::vec3 transmitted(const ShadingPoint& point, const LightArrival& light) const;

    // Next-event estimation (path_lights.cpp): samples of all lights (of the emitters, one point),
    // and what `point` reflects of those that are visible. Where there are many punctual lights, so many are
    // drawn; 0: none is sampled.
    void sample_lights(const ShadingPoint& point, int punctual_draws, Random& random,
                       LightSamples& samples) const;
    void sample_punctual(const ShadingPoint& point, int draws, Random& random, LightSamples& samples) const;
    void add_sample(const ShadingPoint& point, const LightArrival& light, LightSamples& samples) const;
    BsdfValue visible_light(const ShadingPoint& point, const LightSamples& samples) const;
    // Emission met by a ray that was drawn with density bsdf_pdf, with its MIS weight.
    glm::vec3 environment_met(glm::vec3 wi, float bsdf_pdf) const;
    glm::vec3 emission_met(const Hit& hit, const Surface& surface, const Sender& from, glm::vec3 wi,
                           float bsdf_pdf) const;

    static constexpr int paths_side_by_side = 16;
    // Up to so many punctual lights, all are asked: at every vertex, and at the first where paths share it.
    static constexpr std::size_t all_lights_limit = 4, exact_lights_limit = 256;
    // Of more, so many are drawn at the first vertex, whose noise is seen directly, and at each later one.
    static constexpr int first_draws = 4, later_draws = 2;

    Path start(int x, int y, int sample, const FirstVertex* first,
               const PhotonPass* photons) const;                     // up to the first hit
    void follow(std::span<Path> paths) const;                        // to their ends
    void step(Path& path) const;                                     // past one surface
    bool passes_uncovered(Path& path, const Surface& surface) const; // by chance, where it is blended
    void absorb(Path& path, const Surface* met) const;               // what media take from the present ray
    void send(Path& path, const FirstVertex* known = nullptr) const; // along its ray
    void finish(Path& path) const;
    bool go_on(Path& path, const ShadingPoint& point) const; // from a surface; false where the path ends
    bool pass_straight(Path& path, const ShadingPoint& point, const BsdfSample& sample) const;
    bool scatter(Path& path, const ShadingPoint& point, const BsdfSample& sample) const;
    BsdfValue lit_by_lights(Path& path, const ShadingPoint& point) const;
    void add_met(Path& path, glm::vec3 met) const; // emission that the path's ray meets
    void add_lit(Path& path, const Surface& surface, const BsdfValue& lit) const;
    void add_photons(Path& path, const ShadingPoint& point) const;
    bool is_reflection(int specular_vertices) const {
        return specular_vertices >= 1 && specular_vertices <= settings_.specular_depth;
    }
    bool only_lambertian_matters(const Path& path) const;
    bool is_wanted(const Path& path, bool by_ideal_lobe) const;
    bool more_is_wanted(const Path& path) const;

    // path_first_vertex.cpp
    FirstVertex first_vertex(int x, int y) const; // through the pixel's center
    void add_first_vertex(const ShadingPoint& point, Random& random, PathSample& result) const;
    float openness(const ShadingPoint& point, Random& random) const;
    glm::vec3 unoccluded_bounce(const ShadingPoint& point, Random& random) const;
    glm::vec3 diffuse_reflection(const Surface& surface, glm::vec3 direction, Random& random) const;
    glm::vec3 straight_light(const ShadingPoint& point, const BsdfSample& sent) const;

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
