// SPDX-License-Identifier: MIT
// The truth: unidirectional path tracing with next-event estimation and MIS, as components of light paths.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/parameters.h"
#include "reference/random.h"
#include "scene/raycast.h"

namespace luxel {

// Light-path components (Heckbert's notation, D = the Lambertian lobe, G = a specular lobe, rough or ideal):
//   direct               E L and E (D|G) L without an ideal lobe: emitters seen, and surfaces lit by lights
//   diffuse1             E D D L: exactly one diffuse bounce of directly lit diffuse surfaces
//   diffuse1_unoccluded  the same with the bounce ray's visibility ignored: every surface point x of the
//   scene that
//                        faces the receiver contributes direct(x) whatever lies between (infinitely many
//                        layers)
//   diffuse              E D D+ L: all diffuse bounces
//   specular             full - direct - diffuse: every path with a specular lobe beyond direct light
//   reflections          E S+ then direct: the radiance that `direct` holds for a surface (emission, and
//   light
//                        straight from its sources by all smooth lobes) as seen after 1 to specular_depth
//                        specular vertices, or the environment: what a tracer computes that follows specular
//                        surfaces so deep and returns the direct light of what it ends at. Part of specular.
//   caustics             E D S+ L: light that reaches a Lambertian surface through specular vertices alone.
//                        Part of specular. By photons, unless caustic_method asks for paths
//   caustics_bias        what the photons' radius adds to `caustics`, signed, estimated from two radii; comes
//                        along with it
//   full                 everything
//   photon_bias          what the photons' radius adds to `full` and `specular`, signed; comes along where
//                        they hold photons, see PhotonLights
//   ao                   cosine-weighted occlusion-free share, radius R, see Membership; 1 = open
// Specular (S) are mirrors, glass, and the GGX lobe where the roughness is at most specular_roughness.
// Pixels that see no surface: direct and full hold the environment's radiance; the others 0.
inline const std::vector<std::string> component_names = {
    "direct",   "diffuse1",      "diffuse1_unoccluded", "diffuse", "specular", "reflections",
    "caustics", "caustics_bias", "photon_bias",         "full",    "ao"};

// How far an occluder at distance d < R leaves its direction open: 0, sqrt(d/R), (d/R)^3. tangent: the open
// share of the sphere of radius R/2 that touches the surface, whose chord is R cos: (d/(R cos))^3 with cos^3
// as weight of directions [Umenhoffer2009, eq. 4.6]. exponential: 1 - exp(-d/R), without an end.
enum class Membership { step, sqrt, cubic, tangent, exponential };
inline const std::vector<std::string> membership_names = {"step", "sqrt", "cubic", "tangent", "exponential"};

// paths: unbiased, but blind to point lights and noisy with small ones.
enum class CausticMethod { photons, paths };
inline const std::vector<std::string> caustic_method_names = {"photons", "paths"};

// Whose light comes to `full` and `specular` as photons where it leaves a mirror or glass for another lobe:
// that of punctual lights, which no path can find there; of all lights, biased but less noisy where lamps are
// small; or of none, which leaves out what paths cannot find.
enum class PhotonLights { punctual, all, none };
inline const std::vector<std::string> photon_lights_names = {"punctual", "all", "none"};

struct ReferenceSettings {
    int spp = 64;         // upper bound
    float seconds = 0.0f; // stop after this time when > 0 (at a whole pass)
    float error = 0.0f;   // stop when the relative error (RelativeError) is below, when > 0
    int max_bounces = 64; // path vertices after the first; Russian roulette starts at 4
    int seed = 1;
    bool pixel_center =
        false; // one sub-pixel position, as a rasterizer's; otherwise the pixel's area is integrated
    float ao_radius = 1.0f; // meters
    Membership ao_membership = Membership::step;
    int specular_depth = 8;          // of `reflections`
    float specular_roughness = 0.2f; // up to here a GGX lobe counts as specular
    CausticMethod caustic_method = CausticMethod::photons;
    PhotonLights photon_lights = PhotonLights::punctual;
    int photons = 200000;       // a pass; every sample of the pixels is a pass
    float photon_radius = 1.0f; // pixels, of the first pass
    void visit(Visitor& v);
};

// A running estimate of one view.
struct Estimate {
    int width = 0, height = 0, spp = 0; // samples per pixel so far
    Layers mean;                        // by component
    Layers variance;                    // of the mean, per pixel and channel
    // Means of the samples s with the same s % sample_groups, independent of each other: the noise made
    // visible.
    std::array<Layers, sample_groups> group;
    Image mask;                        // 1 where the pixel's center sees a surface
    std::vector<std::string> warnings; // one sentence each
};

// Mean over the pixels that are not black of standard error over mean, in luminance, from the scatter of the
// groups.
struct RelativeError {
    double value = 0, uncertainty = 0; // its own standard error: groups are few, and so may be pixels
};
// Below so many samples the groups say nothing about each other.
inline constexpr int samples_for_error = 16;
// Of the sum of `components`; empty: of `full`, or of the first component where full is absent. Nothing below
// samples_for_error.
std::optional<RelativeError> relative_error(const Estimate& estimate,
                                            const std::vector<std::string>& components = {});

// How far `component` (caustics, full or specular) is off, as root mean squares over the pixels, in
// luminance, relative to that of the image itself: by noise, and by the radius of the photons (0 where paths
// were traced), whose own noise is taken out.
struct PhotonError {
    double noise = 0, bias = 0;
};
PhotonError photon_error(const Estimate& estimate, const std::string& component = "caustics");

struct ReferenceRequest {
    std::vector<std::string> components; // of component_names
    std::vector<std::string> error_of;   // the sum that settings.error is about; empty: see relative_error
    int width = 0, height = 0;
    Camera camera;
    ReferenceSettings settings;
    std::filesystem::path checkpoint;     // resumed from and written to when not empty
    std::function<bool(int spp)> watch{}; // called after every pass, which is short then; false: stop there
    bool quiet = true;                    // no progress
};

// 1 where the ray through the pixel's center meets a surface between the camera's near and far.
Image surface_mask(const RayCaster& rays, const Camera& camera, int width, int height);

// Deterministic for a seed whatever the thread count. Throws Error (Fault::usage) on unknown components.
Estimate render_reference(const RayCaster& rays, const ReferenceRequest& request);

} // namespace luxel
