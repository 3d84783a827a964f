// SPDX-License-Identifier: MIT
// Where the photons of caustics start: at the first specular surface of a path that turns the light, found by
// area, its light by the samplers of next-event estimation, straight through thin sheets as there. It does
// for any light what a projection map [Jensen2001, section 7.2.1] does for a point light: no photon is sent
// where nothing specular is.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "reference/light_sampler.h"
#include "reference/media.h"
#include "scene/lights.h"

namespace luxel {

// Light on its way from a specular surface.
struct PhotonPath {
    Ray ray;
    glm::vec3 power; // W
    Media media;     // that it is inside of
};

class PhotonSource {
public:
    // Keeps a reference to `rays` and its scene. A first look at all that may be specular tells how much
    // light each triangle would send on; photons are drawn by that, and some by area for what the look has
    // missed.
    // only_punctual: of no emitter and no environment.
    PhotonSource(const RayCaster& rays, float specular_roughness, bool only_punctual);

    bool empty() const { return targets_.empty(); }
    // The mean of what photons carry is the light that leaves specular surfaces which lights reach straight,
    // save what goes straight on there, too: next-event estimation finds it. Nothing where the drawn light
    // does not reach the drawn point.
    std::optional<PhotonPath> start(Random& random) const;

private:
    enum Kind { punctual, emitter, environment, kind_count };
    struct Target {
        glm::vec3 a, b, c;
        glm::vec3 normal; // unit, of the front
        std::uint32_t instance, triangle;
        float area;
        float chance; // of being drawn

        glm::vec3 at(glm::vec2 uv) const { return a + (b - a) * uv.x + (c - a) * uv.y; }
        Hit hit(glm::vec2 uv) const { return {0.0f, instance, triangle, uv.x, uv.y, normal, nullptr}; }
    };
    using ByKind = std::array<double, kind_count>;
    // Light of one kind at a point of a surface with this normal; its radiance is over the chance of choosing
    // it.
    LightArrival arrival(Kind kind, glm::vec3 position, glm::vec3 normal, Random& random) const;
    LightArrival one_punctual(glm::vec3 position, glm::vec3 normal, float u) const;

    std::array<bool, kind_count> kinds_there() const;
    void find_targets();
    void look_at_targets();
    double sent_on(const Target& target, glm::vec2 uv, const shared::Light& from) const;
    void set_chances(const std::vector<ByKind>& sent);

    const RayCaster* rays_;
    const Scene* scene_;
    float specular_roughness_;
    bool only_punctual_;
    LightSampler lights_;
    std::vector<Target> targets_;
    std::vector<double> cumulative_; // chances up to and with target i
    std::array<float, kind_count> kind_chance_{};
};

// Continues a path of light at a surface by its specular lobes. A path that loses light is ended instead with
// a chance, so that photons stay equally strong.
enum class PhotonTurn { ended, straight, turned };
PhotonTurn scatter_photon(PhotonPath& path, const Surface& surface, float specular_roughness, Random& random);

} // namespace luxel
