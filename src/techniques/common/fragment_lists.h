// SPDX-License-Identifier: MIT
// Per-pixel lists of all surfaces in a view, and rays through them (common/fragment_lists.glsl).
#pragma once
#include "techniques/common/fragment_lists_params.h"
#include "techniques/frame/frame.h"
#include "techniques/frame/projection.h"

namespace luxel {

// What rays are traced in.
struct ListProjection {
    shared::ListView view;
    glm::mat4 world_to_clip;
};

// `margin` more on each side, as a share of the half width. Square images whatever the camera's aspect.
ListProjection list_view_of_camera(const shared::ViewParams& camera, const Bounds& scene, int side,
                                   float margin);
// The box from a fixed direction, orthographic: an equal angle with all axes, so that no axis-aligned
// surface is seen edge-on.
ListProjection list_view_of_box(const Bounds& scene, int side);

class FragmentLists {
public:
    FragmentLists() = default;
    FragmentLists(gpu::Gpu& gpu, const Scene& scene);

    // Draws the scene's lists. The pool of nodes grows until all fit: what is recorded so far is run, and the
    // drawing once more where the pool was too small. Error Fault::resource: more nodes than a buffer can
    // hold.
    void capture(gpu::Recorder& recorder, const GpuScene& scene, const ListProjection& projection);

    // The nearest `layers` of them, by depth peeling: the baseline, which misses what is farther.
    void capture_layers(gpu::Recorder& recorder, const GpuScene& scene, const ListProjection& projection,
                        int layers);

    const shared::ListView& view() const { return projection_.view; }
    gpu::Bindings bindings() const;                        // heads, nodes
    const gpu::Image& min_max() const { return min_max_; } // RG32F with mips: -least and greatest depth
    const gpu::Buffer& shading() const { return shading_; }
    const gpu::Buffer& materials() const { return materials_; }
    std::uint32_t node_count() const { return used_ - 1; } // of capture()
    std::uint64_t bytes() const;

    std::uint32_t capacity = 1u << 16; // of the pool, nodes

private:
    void begin(gpu::Recorder& recorder, const ListProjection& projection, std::uint32_t nodes);
    void reserve(gpu::Gpu& gpu, std::uint32_t nodes);
    void draw(gpu::Recorder& recorder, const GpuScene& scene, gpu::RasterPass pass,
              const std::string& program, const gpu::Bindings& targets) const;
    void finish(gpu::Recorder& recorder);

    ListProjection projection_{};
    std::uint32_t used_ = 1; // nodes, with node 0, which is none
    gpu::Buffer heads_, nodes_, shading_, count_, materials_;
    gpu::Image min_max_;
};

} // namespace luxel
