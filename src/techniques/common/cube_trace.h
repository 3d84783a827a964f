// SPDX-License-Identifier: MIT
// A layered distance cube that rays can be traced through: specular surfaces in near layers, all others in
// one far layer [Umenhoffer2009, 5.1]. Shaders trace with common/cube_trace.glsl.
#pragma once
#include "scene/roles.h"
#include "techniques/common/cube_trace_params.h"
#include "techniques/common/distance_cube.h"
#include "techniques/technique.h"

namespace luxel {

// How a hit is found. none: environment mapping, by direction alone. parallax: corrected by the distance
// there. Others: linear search, then secant or binary refinement.
enum class CubeSearch { none, parallax, linear, secant, binary };
inline const std::vector<std::string> cube_search_names = {"none", "parallax", "linear", "secant", "binary"};
// peeled: by distance from the center; faces: front sides and back sides, as the thesis has it.
enum class NearLayers { peeled, faces };
// One distance cube in the middle of all specular objects, or one at each.
enum class DistanceMaps { one, each };

// What is captured, and how rays march through it.
struct CubeTraceOptions {
    int size = 256; // texels a side of a face
    NearLayers near = NearLayers::peeled;
    int layers = 3; // of specular surfaces, when peeled
    int linear = 32, refine = 8;
    float jump = 0.3f;
    int depth = 6;
    DistanceMaps maps = DistanceMaps::each;
    void visit(Visitor& v, CubeSearch search = CubeSearch::secant); // that they are marched by
};

// How paths from the camera use it.
struct CubePathOptions {
    CubeSearch search = CubeSearch::secant;
    float least_weight = 0.01f;
    bool both = true;
    void visit(Visitor& v);
};

Need specular_need(const std::vector<SceneObject>& specular);

// The world bounds of what each cube is for: of more than CUBE_MAX_OBJECTS objects, those close together
// share one.
std::vector<Bounds> bounds_of_maps(const GpuScene& scene, const std::vector<SceneObject>& specular,
                                   DistanceMaps maps);
// A sentence where they do.
std::vector<std::string> shared_maps_warning(const std::vector<SceneObject>& specular, DistanceMaps maps);
// Divides boxes into at most `most` groups of neighbors, each given as its union: the widest group is cut at
// its median, again and again.
std::vector<Bounds> group_boxes(const std::vector<Bounds>& boxes, std::size_t most);
shared::CubeObjects cube_objects(const std::vector<Bounds>& maps); // own = 0

struct TracedCube {
    DistanceCube cube;
    gpu::Image ranges;
    shared::CubeTraceParams params;
    gpu::Image environment; // what rays show that leave the scene
    float environment_rotation = 0.0f, environment_scale = 0.0f;

    // What common/cube_trace.glsl declares.
    gpu::Bindings bindings() const;
};

// What a capture shows, where paths start.
gpu::Bindings first_surfaces(const Capture& seen);

// What the far layer's radiance holds: what surfaces emit, also their direct light, also what else lights
// them.
enum class CubeRadiance { emitted, direct, lit };

// Around `center` (world): near layers of `specular`, which `search` may do without, a far one of the rest of
// the scene.
TracedCube capture_traced_cube(gpu::Recorder& recorder, const Frame& frame,
                               const std::vector<SceneObject>& specular, glm::vec3 center,
                               const CubeTraceOptions& options, CubeSearch search, CubeRadiance radiance,
                               const std::string& prefix);

// Adds to `sum` (RGBA32F, as large as the capture) what its specular surfaces show of the cube's radiance:
// those that belong to the object objects.own.
void trace_view(gpu::Recorder& recorder, const Capture& seen, const TracedCube& traced,
                const shared::CubeObjects& objects, const CubePathOptions& paths, const gpu::Image& sum);

} // namespace luxel
