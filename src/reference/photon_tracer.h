// SPDX-License-Identifier: MIT
// Photons of a pass, from lights through specular surfaces to where they end, and the light that a surface
// reflects of those around it. A pass depends on nothing but its number [Knaus2011].
#pragma once
#include <functional>

#include "reference/bsdf.h"
#include "reference/photon_map.h"
#include "reference/photon_source.h"
#include "reference/reference.h"

namespace luxel {

// Radius of a pass over that of the first: the squares shrink by (i + alpha) / (i + 1) [Knaus2011, eq. 15],
// with alpha = 2/3, for which variance and squared bias of the mean fall alike.
float relative_photon_radius(int pass);

// Which photons there are. Different ways have random numbers of their own.
struct PhotonWay {
    float specular_roughness; // they pass mirrors, glass and GGX lobes up to here; below 0: ideal lobes alone
    bool only_punctual;       // of point, spot and directional lights, or of all
    shared::uint seed;
    std::function<bool(const Surface&)> is_kept; // where a photon is stored on its way
};

class PhotonTracer {
public:
    // Keeps a reference to `rays`.
    PhotonTracer(const RayCaster& rays, const ReferenceSettings& settings, PhotonWay way);

    bool empty() const { return source_.empty(); } // no photon can ever start
    PhotonMap trace(int pass) const;

private:
    void trace_photon(int pass, int index, std::vector<Photon>& stored) const;

    const RayCaster* rays_;
    ReferenceSettings settings_;
    PhotonWay way_;
    PhotonSource source_;
};

// One pass as camera paths meet it.
struct PhotonPass {
    PhotonMap map;
    float radius; // at the distance 1, or everywhere (orthographic)
};

// Radiance that the smooth lobes of `point` reflect of the photons within `radius`, and what the radius adds
// to it: with an error that grows as r^2, twice the difference to the radius r / sqrt 2 is that error.
struct PhotonLight {
    glm::vec3 whole{0.0f}, bias{0.0f};
};
PhotonLight reflected_photons(const PhotonMap& map, const ShadingPoint& point, float radius);

} // namespace luxel
