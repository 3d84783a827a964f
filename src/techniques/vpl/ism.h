// SPDX-License-Identifier: MIT
// Visibility of virtual point lights by imperfect shadow maps [Ritschel2008].
#pragma once
#include "techniques/common/vpl.h"
#include "techniques/vpl/ism_params.h"

namespace luxel {

struct IsmOptions {
    int size = 64;     // texels a side of each light's map
    int points = 4096; // that each is drawn with
    void visit(Visitor& v);
};

// Points on the scene's surfaces, evenly by area, in sets that are each spread over all of them.
struct IsmPoints {
    gpu::Buffer points;      // shared::IsmPoint; move with their instances
    int sets = 0, count = 0; // points in each set
    float area = 0.0f;       // of the scene's surfaces, m2
};
IsmPoints ism_points(gpu::Gpu& gpu, const Scene& scene, const IsmOptions& options);

// What gathering binds as "shadow_maps" and reads by its parameters.
struct IsmMaps {
    gpu::Image maps; // R32F, 1/distance of the nearest surface; 0: none
    shared::IsmParams params;
};
IsmMaps imperfect_shadow_maps(gpu::Recorder& recorder, const Frame& frame, const IsmPoints& points,
                              const Vpls& vpls, const IsmOptions& options);

} // namespace luxel
