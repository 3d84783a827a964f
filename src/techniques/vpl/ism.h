// SPDX-License-Identifier: MIT
// Visibility of virtual point lights by imperfect shadow maps [Ritschel2008].
#pragma once
#include <optional>

#include "techniques/common/vpl.h"
#include "techniques/vpl/ism_params.h"

namespace luxel {

struct IsmOptions {
    int size = 64;      // texels a side of each light's map
    int points = 16384; // that each is drawn with
    void visit(Visitor& v);
};

// Points on the scene's surfaces, in sets that are each spread over all of them.
struct IsmPoints {
    gpu::Buffer points;      // shared::IsmPoint; move with their instances
    int sets = 0, count = 0; // points in each set
};
// Evenly by area; with an eye, by area over the squared distance from it, so that what is near to what one
// sees is known best.
IsmPoints ism_points(gpu::Gpu& gpu, const Scene& scene, const IsmOptions& options,
                     std::optional<glm::vec3> eye = std::nullopt);
// Meters within which the squared distance counts as if it were this one.
float ism_near(const Scene& scene);

// What gathering binds as "shadow_maps" and reads by its parameters.
struct IsmMaps {
    gpu::Image maps; // R32F, 1/distance of the nearest surface; 0: none
    shared::IsmParams params;
};
IsmMaps imperfect_shadow_maps(gpu::Recorder& recorder, const Frame& frame, const IsmPoints& points,
                              const Vpls& vpls, const IsmOptions& options);

} // namespace luxel
