// SPDX-License-Identifier: MIT
// What every frame offers to a technique.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/parameters.h"
#include "gpu/recorder.h"
#include "scene/scene.h"
#include "shared/height_search.h"
#include "techniques/frame/ambient_params.h"
#include "techniques/frame/gpu_scene.h"
#include "techniques/frame/view_params.h"

namespace luxel {

// Full-size images of the visible surfaces; background pixels have depth 0.
struct GBuffer {
    gpu::Image diffuse;  // RGBA16F: Brdf::diffuse (albedo of the Lambertian lobe), a = perceptual roughness,
                         // 0 exactly for an ideal mirror, whose specular lobe direct light leaves out
    gpu::Image specular; // RGBA16F: Brdf::f0, a = f90
    gpu::Image normal;   // RGBA16F: world shading normal facing the camera's side, a = its coverage: 1 where
                         // there is a surface, less where it is alpha-blended (CaptureRequest::blended)
    gpu::Image geometric_normal; // RGBA16F: world normal of the triangle, toward the camera; a = 1 where its
                                 // front is seen, -1 where its back is
    gpu::Image depth; // R32F: distance along the view direction ("linear eye z"), meters; 0 = background
    gpu::Image hardware_depth; // D32F
};

// The surfaces that one view sees, and the direct light on them.
struct Capture {
    std::uint32_t width = 0, height = 0;
    shared::ViewParams view; // camera as shaders read it; world position = position + depth * pixel_direction
    const GpuScene* scene = nullptr;
    std::optional<shared::HeightSearch> search; // of height maps; none: they are not looked at
    GBuffer gbuffer;
    gpu::Image direct; // RGBA32F: direct radiance toward the camera, emission included, without ambient;
                       // a = signed_ior (shared/brdf.h)
    gpu::Image direct_diffuse; // RGBA32F: the part of it that the Lambertian lobe reflects (no emission, no
                               // specular)
};

// Which sides of surfaces a capture shows: all, but behind `farther_than` no backs of single-sided surfaces
// (they are the insides of solids); those that the scene's cameras see, which is for views from their places;
// both without exception; or one alone.
enum class Sides { standard, seen, all, front, back };

struct CaptureRequest {
    shared::ViewParams view; // width and height are the capture's
    std::string prefix;      // of its images' names, "" for the frame's own
    // R32F, as large as the view: only what is farther than it, along the view direction, is drawn
    // [Everitt2001]. Empty: all.
    gpu::Image farther_than;
    // Depths in farther_than are of the frame's own surfaces: what the frame shows as an impostor is left
    // out, as nothing is behind it.
    bool behind_frame = false;
    Sides sides = Sides::standard;
    bool blended = false;    // only what covers a part of its pixel; otherwise only what covers all of it
    std::vector<bool> drawn; // by the scene's instances; empty: all. The others still cast shadows.
};

// The capture of the camera's view, and what else a technique may ask for.
struct Frame : Capture {
    Camera camera;
    gpu::Image ambient; // RGBA32F: unoccluded environment light off the diffuse lobe; black without
    shared::AmbientParams ambient_sh{}; // the environment's radiance that `ambient` is made of; 0 without
    // The scene again, from another view or behind what one sees, by the passes that made this frame.
    std::function<Capture(gpu::Recorder&, const CaptureRequest&)> capture;
    // The two halves of it. Surfaces: `direct` holds what they emit, `direct_diffuse` nothing. Light: adds
    // the lights to several captures and draws each shadow map once for them all.
    std::function<Capture(gpu::Recorder&, const CaptureRequest&)> capture_surfaces;
    std::function<void(gpu::Recorder&, const std::vector<Capture>&)> add_light;
    std::uint64_t motion =
        0; // changes when instances or lights have moved; what was captured before is old then
    // Adds to `direct` of captures that have their direct light what else lights them in this frame: ambient
    // light, unoccluded, and what techniques light whose slots come before that of the caller.
    std::function<void(gpu::Recorder&, const std::vector<Capture>&)> add_indirect;
    gpu::Image environment; // equirectangular radiance before rotation and scale; 1x1 black without one
};

enum class ShadowMode { hard, pcf, esm };
// How the environment lights the frame: not at all, as SH irradiance times the occlusion slot, or as shadowed
// directional lights drawn by importance.
enum class EnvironmentMode { none, ambient, lights };

struct FrameOptions {
    ShadowMode shadow = ShadowMode::pcf;
    int shadow_size = 2048;     // texels a side
    int shadow_memory = 1024;   // MiB of shadow maps that are kept while what they show does not move
    float esm_exponent = 90.0f; // for light depth in [0, 1]
    int emitter_lights = 64;    // cosine-emitting samples of emissive meshes
    EnvironmentMode environment = EnvironmentMode::lights;
    int environment_lights = 32;
    int seed = 1;
    int supersample =
        1; // the frame and all techniques at this many times the width and height, then averaged
    int blend_layers =
        8; // nearest alpha-blended surfaces of a pixel that are drawn; farther ones are left out
    bool mipmaps = true; // false: mip 0 only, as the reference looks textures up
    void visit(Visitor& v);
};
// Whether the environment lights the frame as the ambient term.
bool has_ambient_light(const Scene& scene, const FrameOptions& options);

} // namespace luxel
