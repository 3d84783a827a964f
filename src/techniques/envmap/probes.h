// SPDX-License-Identifier: MIT
// Where the probes of diffuse environment mapping stand, and what they send.
#pragma once
#include "scene/roles.h"
#include "techniques/common/distance_cube.h"
#include "techniques/envmap/envmap.h"
#include "techniques/envmap/envmap_params.h"

namespace luxel {

// Error Fault::usage: sizes that are no powers of two, or a reduced map larger than the captured one.
void check_envmap_options(const EnvmapOptions& options);

// One at the center of each object's bounds as it stands now; the object itself is not drawn.
std::vector<CubeLayer> object_probes(const GpuScene& scene, const std::vector<SceneObject>& objects);

// The centers of cells that divide the bounds, `longest` along the longest side, about as wide along the
// others. Writes the grid into p.
std::vector<CubeLayer> grid_probes(const Bounds& bounds, int longest, shared::EnvmapGatherParams& p);

struct EnvmapSenders {
    gpu::Buffer list;       // vec4s, see ENVMAP_*; empty for the classic estimator
    gpu::Image convolved;   // cube array, irradiance by normal; of the classic estimator
    gpu::Image distance;    // cube array, of the probes
    gpu::Image prefiltered; // with EnvmapOptions::glossy: radiance by direction, a level for each roughness
};
// What reflectance.comp says; the same for every scene.
gpu::Image tabulate_reflectance(gpu::Gpu& gpu);

EnvmapSenders find_senders(gpu::Recorder& recorder, const Frame& frame, const std::vector<CubeLayer>& probes,
                           const EnvmapOptions& options);

} // namespace luxel
