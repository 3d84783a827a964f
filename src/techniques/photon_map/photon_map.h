// SPDX-License-Identifier: MIT
// Caustics by photons that are traced through lists of fragments and splatted on what is seen [Le2014, 3.3].
#pragma once
#include "techniques/common/fragment_lists.h"
#include "techniques/common/rsm.h"
#include "techniques/photon_map/photon_map_params.h"
#include "techniques/technique.h"

namespace luxel {

enum class PhotonCapture { camera, box };
enum class PhotonTracer { march, lines, layers };
enum class PhotonDisc { beam, differential };
enum class PhotonKernel { tent, cone, gaussian };
inline const std::vector<std::string> photon_kernels = {"tent", "cone", "gaussian"};

struct PhotonBuffers {
    gpu::Buffer photons, hits, counts;
    int most = 0;
};

struct PhotonOptions {
    RsmOptions rsm;
    int photons = 16384;
    PhotonCapture capture = PhotonCapture::camera;
    float margin = 0.25f;
    int side = 256;
    PhotonTracer tracer = PhotonTracer::march;
    int layers = 4;
    bool skip = true;
    int bounces = 4;
    bool both = true, mixed = true;
    PhotonKernel kernel = PhotonKernel::tent;
    PhotonDisc disc = PhotonDisc::differential;
    float share = 12.0f;
    int scale = 1;
    void visit(Visitor& v);
};

ListProjection list_projection(const Frame& frame, const PhotonOptions& options);
// The lists, or for tracer=layers the nearest surfaces alone.
void capture_lists(gpu::Recorder& recorder, FragmentLists& lists, const GpuScene& scene,
                   const ListProjection& projection, const PhotonOptions& options);
// At most options.photons of them, twice as many where glass splits each.
PhotonBuffers emit_photons(gpu::Recorder& recorder, const std::vector<RsmView>& views, glm::vec3 center,
                           const PhotonOptions& options);
// Of rays that fly: PhotonHit of each.
void trace_photons(gpu::Recorder& recorder, const FragmentLists& lists, const PhotonBuffers& photons,
                   const PhotonOptions& options);
// Rays and what they meet in turn, until all photons have arrived or are lost.
void follow_photons(gpu::Recorder& recorder, const FragmentLists& lists, const PhotonBuffers& photons,
                    const PhotonOptions& options);
// W/m2, of the view's size.
gpu::Image photon_irradiance(gpu::Recorder& recorder, const Capture& seen, const PhotonBuffers& photons,
                             glm::vec3 center, const PhotonOptions& options);

} // namespace luxel
