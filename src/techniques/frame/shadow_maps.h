// SPDX-License-Identifier: MIT
// Which shadow maps a light needs, and drawing them.
#pragma once
#include <vector>

#include "gpu/recorder.h"
#include "techniques/frame/frame.h"
#include "techniques/frame/shadow_params.h"
#include "techniques/frame/sheets.h"

namespace luxel {

// A light and its maps; first_map is given when a batch is put together.
struct FittedLight {
    shared::ShadowedLight light;
    std::vector<shared::ShadowView> views;
};

// Point: the 6 faces of a cube. Cosine, and spots wider than 120 degrees: 5 faces, none behind the light's
// plane. Other spots: one cone. Directional: one box around `receivers` (what the camera can see), as deep as
// the scene.
FittedLight fit_shadow_maps(const shared::Light& light, const Bounds& scene,
                            const std::vector<glm::vec3>& receivers, int size);

// Number of maps that fit_shadow_maps gives the light.
int shadow_map_count(const shared::Light& light);

// The square perspective views that together see what a light can reach, in the order of shared::cube_face
// (shadow_params.h); none for a directional light.
struct LightCone {
    glm::vec3 forward, right, up; // unit; may be left-handed
    float tangent;                // of half the view's angle
};
std::vector<LightCone> light_cones(const shared::Light& light);

// Maps as frame/direct.glsl reads them, a layer for each view: reversed depth of what is solid, or for
// exponential maps the filtered linear depth; and where any view sees thin sheets, what those let through.
struct ShadowImages {
    gpu::Image depth;
    SheetTargets sheets; // empty handles: none is seen
};

// An array of maps of one size.
class ShadowMaps {
public:
    ShadowMaps(gpu::Gpu& gpu, int size, int layers, ShadowMode mode, bool with_sheets);
    int size() const { return int(depth_.width()); }
    int layers() const { return int(depth_.info().layers); }

    // Draws the scene into the first views.size() maps; filters them for ShadowMode::esm. search: of height
    // maps; none: they are not looked at.
    ShadowImages draw(gpu::Recorder& recorder, const GpuScene& scene,
                      const std::vector<shared::ShadowView>& views, float esm_exponent,
                      const std::optional<shared::HeightSearch>& search) const;
    bool with_sheets() const { return bool(sheets_.nearest); }
    std::uint64_t bytes() const {
        return bytes_of(size(), layers(), mode_, with_sheets());
    } // of device memory, without padding
    static std::uint64_t bytes_of(int size, int layers, ShadowMode mode, bool with_sheets);

private:
    ShadowMode mode_;
    gpu::Image depth_;                // D32F
    gpu::Image filtered_, temporary_; // R32F, ShadowMode::esm only
    SheetTargets sheets_;
};

} // namespace luxel
