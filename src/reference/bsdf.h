// SPDX-License-Identifier: MIT
// How a surface scatters: evaluation of the smooth lobes, and the choice of a direction among all of them.
#pragma once
#include "reference/random.h"
#include "scene/surface.h"

namespace luxel {

// A surface as its ray meets it: everything turned to the ray's side, with the chances of its lobes.
struct ShadingPoint {
    ShadingPoint(const Surface& surface, glm::vec3 direction);

    const Surface* surface;
    glm::vec3 wo;               // unit, back along the ray
    glm::vec3 normal;           // shading normal, dot(normal, wo) > 0
    glm::vec3 geometric_normal; // unit, dot(geometric_normal, wo) >= 0
    glm::vec3 coat_normal;      // dot(coat_normal, wo) > 0
    bool mirror;                // the specular lobe is ideal
    bool rough_glass;           // glass has a smooth lobe on both sides; otherwise it is ideal
    // Of sampling a lobe; they sum to 1, or to 0: a black surface.
    float diffuse_chance, specular_chance, glass_chance, coat_chance;

    bool has_smooth_lobes() const {
        return diffuse_chance > 0.0f || (specular_chance > 0.0f && !mirror) ||
               (glass_chance > 0.0f && rough_glass) || coat_chance > 0.0f;
    }
    // Of the side that smooth lobes take light from; zero: from both.
    glm::vec3 receiving_normal() const {
        return glass_chance > 0.0f && rough_glass ? glm::vec3(0.0f) : normal;
    }
    // Origin of a ray that leaves on the side of `direction`.
    glm::vec3 origin(glm::vec3 direction) const;
};

// The smooth lobes, 1/sr times the cosine, and the density of sample_bsdf. Below the geometric horizon only
// rough glass has any; `specular` has all lobes but the Lambertian.
struct BsdfValue {
    glm::vec3 diffuse{0.0f}, specular{0.0f};
    float pdf = 0.0f;
    glm::vec3 sum() const { return diffuse + specular; }
};
BsdfValue evaluate_bsdf(const ShadingPoint& point, glm::vec3 wi);

// The surface as if it had no lobe but the Lambertian.
Surface lambertian_part(Surface surface);

// A specular lobe (S) is one of a mirror or of smooth glass, or the GGX lobe or the rough glass of a surface
// that is at most so rough.
inline bool has_specular_ggx(const Surface& surface, float specular_roughness) {
    return surface.roughness <= specular_roughness;
}
// The surface as if it had no other lobes than specular ones.
Surface specular_part(Surface surface, float specular_roughness);

struct BsdfSample {
    glm::vec3 wi{0.0f};      // unit
    glm::vec3 weight{0.0f};  // all lobes over the density; zero ends the path
    glm::vec3 diffuse{0.0f}; // the Lambertian lobe's share of it
    float pdf = 0.0f;        // of a smooth lobe, 1/sr
    bool ideal = false;      // mirror or glass: no density
    bool straight = false;   // through a thin sheet without a bend: light of the same straight line
};
// flux: of light that comes from wo and leaves along wi, as photons carry it. Radiance is compressed in a
// denser medium, flux is not; and where the shading normal is not the geometric one, what a path tracer takes
// for the surface's reflection is another factor for flux [Veach1997, section 5.3].
enum class Transport { radiance, flux };
BsdfSample sample_bsdf(const ShadingPoint& point, Random& random, Transport transport = Transport::radiance);

} // namespace luxel
