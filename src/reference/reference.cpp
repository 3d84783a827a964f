// SPDX-License-Identifier: MIT
// Passes over the image until enough is known.
#include "reference/reference.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "core/closest.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "reference/caustics.h"
#include "reference/checkpoint.h"
#include "reference/content_key.h"
#include "reference/film.h"
#include "reference/path_tracer.h"
#include "reference/stopping.h"

namespace luxel {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int tile_side = 16;
constexpr int pass_samples = 32;          // between looks at the clock for a checkpoint
constexpr double checkpoint_seconds = 30; // at most so much work is lost
constexpr double watched_seconds = 0.25;  // about so long is a pass that somebody watches
constexpr int photons_at_once = 1 << 21;  // traced before the samples that look at them
constexpr int passes_at_once = 8;
constexpr int runs_for_variance = 8;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

void check(const ReferenceRequest& request) {
    if (request.width <= 0 || request.height <= 0 || request.width > max_image_side ||
        request.height > max_image_side)
        fail(Fault::usage, "reference: size {}x{} is not between 1x1 and {}x{}", request.width,
             request.height, max_image_side, max_image_side);
    if (request.components.empty())
        fail(Fault::usage, "reference: no component asked for; known: {}", fmt::join(component_names, ", "));
    for (const std::string& name : request.components)
        if (!contains(component_names, name))
            fail(Fault::usage, "reference: unknown component \"{}\"; {}", name,
                 known_are(name, component_names));
    if (contains(request.components, "photon_bias") && !contains(request.components, "full") &&
        !contains(request.components, "specular"))
        fail(Fault::usage,
             "reference: photon_bias is of the photons in full and specular; ask for one of them, too");
    for (const std::string& name : request.error_of)
        if (!contains(request.components, name))
            fail(Fault::usage,
                 "reference: the error is to be that of \"{}\", which is no component asked for", name);
    if (request.settings.spp < 1) fail(Fault::usage, "reference: spp is {}, below 1", request.settings.spp);
}

// body(x, y) for every pixel, tile by tile.
template <class Body> void for_each_pixel(int width, int height, Body&& body) {
    const int columns = (width + tile_side - 1) / tile_side, rows = (height + tile_side - 1) / tile_side;
    parallel_for(std::size_t(columns) * std::size_t(rows), 1, [&](std::size_t tile) {
        const int left = int(tile) % columns * tile_side, top = int(tile) / columns * tile_side;
        for (int y = top; y < std::min(top + tile_side, height); ++y)
            for (int x = left; x < std::min(left + tile_side, width); ++x) body(x, y);
    });
}

// Components once each: a name given twice is one layer. Photons never come without what their radius does.
std::vector<std::string> unique(const ReferenceRequest& request, bool with_photons) {
    const bool photons = request.settings.caustic_method == CausticMethod::photons;
    std::vector<std::string> result;
    for (const std::string& name : component_names)
        if (contains(request.components, name) ||
            (name == "caustics_bias" && photons && contains(request.components, "caustics")) ||
            (name == "photon_bias" && with_photons))
            result.push_back(name);
    return result;
}

// The photons of `full` and `specular`, if there are any: past ideal lobes alone, as paths find all that
// others send on.
std::optional<PhotonTracer> photons_for_paths(const RayCaster& rays, const ReferenceRequest& request) {
    constexpr shared::uint seed = 0x66756c6cu; // parts them from those of caustics
    const PhotonLights lights = request.settings.photon_lights;
    if (lights == PhotonLights::none ||
        !(contains(request.components, "full") || contains(request.components, "specular")))
        return std::nullopt;
    const auto is_kept = [](const Surface& surface) {
        return surface.brdf.diffuse != glm::vec3(0.0f) ||
               (surface.brdf.f0 + surface.brdf.f90 != glm::vec3(0.0f) &&
                !shared::is_mirror(surface.metallic, surface.roughness));
    };
    PhotonTracer tracer(rays, request.settings, {-1.0f, lights == PhotonLights::punctual, seed, is_kept});
    return tracer.empty() ? std::nullopt : std::optional(std::move(tracer));
}

// What photons alone are traced for.
std::vector<std::string> photon_components(const ReferenceRequest& request) {
    std::vector<std::string> names;
    for (const std::string& name : request.components)
        if (name == "caustics_bias" ||
            (name == "caustics" && request.settings.caustic_method == CausticMethod::photons))
            names.push_back(name);
    return names;
}

// One pass of photons for each sample of the pixels.
void add_photons(const CausticTracer& tracer, const std::vector<std::string>& components, int first,
                 int count, Film& film) {
    const auto place = [&](const char* name) {
        return std::size_t(std::find(components.begin(), components.end(), name) - components.begin());
    };
    const std::size_t caustics = place("caustics"), bias = place("caustics_bias");
    for (int pass = first; pass < first + count; ++pass)
        tracer.trace_pass(pass, [&](int x, int y, glm::vec3 light, glm::vec3 of_radius) {
            if (caustics < components.size()) film.add(x, y, pass, caustics, light);
            film.add(x, y, pass, bias, of_radius);
        });
}

// Camera paths for `count` samples of every pixel, each with a pass of photons of its own.
void add_paths(const PathTracer& tracer, const std::optional<PhotonTracer>& photons,
               const ReferenceRequest& request, int first, int count, Film& film) {
    const ReferenceSettings& settings = request.settings;
    const float pixel =
        camera_basis(request.camera, request.width, request.height).pixel_side(request.height, 1.0f);
    const int block =
        photons ? std::clamp(photons_at_once / settings.photons, 1, passes_at_once) : std::max(count, 1);
    std::vector<PhotonPass> passes;
    for (int begin = first, end = first + count; begin < end; begin += block) {
        const int samples = std::min(block, end - begin);
        passes.clear();
        for (int i = 0; photons && i < samples; ++i)
            passes.push_back({photons->trace(begin + i),
                              settings.photon_radius * relative_photon_radius(begin + i) * pixel});
        for_each_pixel(request.width, request.height, [&](int x, int y) {
            tracer.trace_samples(x, y, begin, samples, passes,
                                 [&](int s, const PathSample& value) { film.add(x, y, s, value); });
        });
    }
}

// Samples of the next pass: up to the next look at the error; single samples where the clock decides.
int next_pass(const ReferenceSettings& settings, int spp) {
    if (settings.seconds > 0.0f) return 1;
    const int block = pass_samples - spp % pass_samples;
    const int to_look = settings.error > 0.0f ? next_look(spp) - spp : block;
    return std::min({block, to_look, settings.spp - spp});
}

// Whether the error is below its target for all that is known of it.
bool is_enough(const ReferenceRequest& request, const Film& film, int spp) {
    if (!(request.settings.error > 0.0f) || !is_look(spp)) return false;
    const auto error = relative_error(film.estimate(spp), request.error_of);
    return error && error->value + error->uncertainty < double(request.settings.error);
}

// Where somebody watches, passes are as short as the speed so far allows.
int watched_pass(const ReferenceRequest& request, int next, int done, double seconds) {
    if (!request.watch) return next;
    const double a_second = done > 0 ? double(done) / std::max(seconds, 1e-6) : 0.0;
    return std::clamp(int(std::min(a_second * watched_seconds, 1e6)), 1, next);
}

// A run that has just begun has little to lose, but the first seconds of a long one should not be lost.
double checkpoint_after(double seconds) { return std::clamp(seconds, 2.0, checkpoint_seconds); }

} // namespace

void ReferenceSettings::visit(Visitor& v) {
    v.integer("spp", spp, {1, 1 << 24}, "most samples per pixel");
    v.real("seconds", seconds, {0, 1e6}, "stop after this time when above 0");
    v.real("error", error, {0, 1}, "stop when the mean relative standard error is below, when above 0");
    v.integer("max_bounces", max_bounces, {0, 1 << 20}, "path vertices after the first");
    v.integer("seed", seed, {0, 2147483647}, "seed of the random numbers");
    v.flag("pixel_center", pixel_center, "rays through pixel centers instead of the pixels' areas");
    v.real("ao_radius", ao_radius, {1e-6, 1e6}, "radius of ambient occlusion, meters");
    v.choice("ao_membership", ao_membership, membership_names,
             "how an occluder's weight falls with distance");
    v.integer("specular_depth", specular_depth, {1, 1 << 20}, "most specular vertices of reflections");
    v.real("specular_roughness", specular_roughness, {0, 1}, "up to here the GGX lobe counts as specular");
    v.choice("caustic_method", caustic_method, caustic_method_names, "how caustics are computed");
    v.choice("photon_lights", photon_lights, photon_lights_names,
             "lights that reach full and specular as photons through mirrors and glass");
    v.integer("photons", photons, {1, 1 << 28}, "photons of a pass, which is a sample of every pixel");
    v.real("photon_radius", photon_radius, {1e-3, 1e3}, "radius of the photons in the first pass, pixels");
}

Image surface_mask(const RayCaster& rays, const Camera& camera, int width, int height) {
    const CameraBasis basis = camera_basis(camera, width, height);
    Image mask(width, height, 1);
    for_each_pixel(width, height, [&](int x, int y) {
        const glm::vec2 center(float(x) + 0.5f, float(y) + 0.5f);
        Hit hit;
        const bool seen =
            rays.intersect_seen({pixel_origin(basis, width, height, center),
                                 pixel_direction(basis, width, height, center), camera.near, camera.far},
                                hit);
        *mask.at(x, y) = seen ? 1.0f : 0.0f;
    });
    return mask;
}

// Products of independent groups have no noise in their mean: what is left is the square of the bias itself.
PhotonError photon_error(const Estimate& estimate, const std::string& component) {
    const auto found = estimate.mean.find(component);
    if (found == estimate.mean.end()) return {};
    const std::string of_radius = component == "caustics" ? "caustics_bias" : "photon_bias";
    double level = 0.0, noise = 0.0, bias = 0.0; // squares
    for (int y = 0; y < estimate.height; ++y)
        for (int x = 0; x < estimate.width; ++x) {
            const double mean = double(luminance(found->second.rgb(x, y)));
            const double error = double(luminance(glm::sqrt(estimate.variance.at(component).rgb(x, y))));
            level += mean * mean, noise += error * error;
            if (!estimate.mean.contains(of_radius)) continue;
            double all = 0.0, squares = 0.0;
            for (const Layers& group : estimate.group) {
                const double b = double(luminance(group.at(of_radius).rgb(x, y)));
                all += b, squares += b * b;
            }
            bias += (all * all - squares) / double(sample_groups * (sample_groups - 1));
        }
    if (level <= 0.0) return {};
    return {std::sqrt(noise / level), std::sqrt(std::max(bias / level, 0.0))};
}

Estimate render_reference(const RayCaster& rays, const ReferenceRequest& asked) {
    check(asked);
    ReferenceRequest request = asked;
    const std::optional<PhotonTracer> photons = photons_for_paths(rays, asked);
    request.components = unique(asked, photons.has_value());
    const ReferenceSettings& settings = request.settings;
    PathTracer tracer(rays, request);
    const std::vector<std::string> by_photons = photon_components(request);
    std::optional<CausticTracer> caustics;
    if (!by_photons.empty()) caustics.emplace(rays, request);
    Film film(request.width, request.height, request.components, by_photons);

    // Go on where an earlier run of the same inputs stopped.
    CheckpointFound found;
    std::uint64_t key = 0;
    if (!request.checkpoint.empty()) {
        key = content_key(rays.scene(), request);
        found = read_checkpoint(request.checkpoint, key, settings.spp, film.sums());
    }

    int spp = found.spp, saved = found.spp;
    Progress progress("reference", request.quiet);
    const Clock::time_point start = Clock::now();
    Clock::time_point last_save = start;
    auto save = [&] {
        if (request.checkpoint.empty() || saved == spp) return;
        write_checkpoint(request.checkpoint, key, spp, film.sums());
        saved = spp, last_save = Clock::now();
    };

    // Every pixel adds its samples in order, whichever thread it meets: the sums do not depend on scheduling.
    while (spp < settings.spp && !is_enough(request, film, spp)) {
        const int count =
            watched_pass(request, next_pass(settings, spp), spp - found.spp, seconds_since(start));
        if (by_photons.size() < request.components.size())
            add_paths(tracer, photons, request, spp, count, film);
        if (caustics) add_photons(*caustics, request.components, spp, count, film);
        spp += count;
        progress.update(double(spp) / settings.spp);
        if (seconds_since(last_save) > checkpoint_after(seconds_since(start))) save();
        if (request.watch && !request.watch(spp)) break;
        if (settings.seconds > 0.0f && seconds_since(start) >= settings.seconds) break;
    }
    save();
    progress.finish();

    Estimate estimate = film.estimate(spp);
    estimate.mask = surface_mask(rays, request.camera, request.width, request.height);
    if (photons && spp < runs_for_variance)
        estimate.warnings.push_back(
            fmt::format("reference: the variance of {} passes of photons says little, at least {} do", spp,
                        runs_for_variance));
    if (!found.warning.empty()) estimate.warnings.push_back(found.warning);
    return estimate;
}

} // namespace luxel
