// SPDX-License-Identifier: MIT
// Passes over the image until enough is known.
#include "reference/reference.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "reference/checkpoint.h"
#include "reference/content_key.h"
#include "reference/film.h"
#include "reference/path_tracer.h"

namespace luxel {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int tile_side = 16;
constexpr int pass_samples = 32;          // the error target is looked at so often: independent of the clock
constexpr double checkpoint_seconds = 30; // at most so much work is lost

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

void check(const ReferenceRequest& request) {
    if (request.width <= 0 || request.height <= 0 || request.width > max_image_side ||
        request.height > max_image_side)
        fail(Fault::usage, "reference: size {}x{} is not between 1x1 and {}x{}", request.width,
             request.height, max_image_side, max_image_side);
    if (request.components.empty())
        fail(Fault::usage, "reference: no component asked for; known: {}", fmt::join(component_names, ", "));
    for (const std::string& name : request.components)
        if (std::find(component_names.begin(), component_names.end(), name) == component_names.end())
            fail(Fault::usage, "reference: unknown component \"{}\"; known: {}", name,
                 fmt::join(component_names, ", "));
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

// Components once each: a name given twice is one layer.
std::vector<std::string> unique(const std::vector<std::string>& names) {
    std::vector<std::string> result;
    for (const std::string& name : component_names)
        if (std::find(names.begin(), names.end(), name) != names.end()) result.push_back(name);
    return result;
}

// Samples of the next pass: whole blocks between looks at the error; single samples where the clock decides.
int next_pass(const ReferenceSettings& settings, int spp) {
    int block = settings.seconds > 0.0f ? 1 : pass_samples - spp % pass_samples;
    return std::min(block, settings.spp - spp);
}

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
}

double relative_error(const Estimate& estimate) {
    if (estimate.mean.empty()) return 0.0;
    auto full = estimate.mean.find("full");
    const std::string& name = full != estimate.mean.end() ? full->first : estimate.mean.begin()->first;
    const Image &mean = estimate.mean.at(name), &variance = estimate.variance.at(name);
    double sum = 0.0;
    std::size_t count = 0;
    for (int y = 0; y < mean.height; ++y)
        for (int x = 0; x < mean.width; ++x) {
            // Channels of one path rise and fall together, so their standard errors add.
            glm::vec3 v = variance.rgb(x, y);
            double level = luminance(mean.rgb(x, y));
            if (level <= 0.0) continue;
            sum += luminance(glm::sqrt(v)) / level;
            ++count;
        }
    return count > 0 ? sum / double(count) : 0.0;
}

Image surface_mask(const RayCaster& rays, const Camera& camera, int width, int height) {
    const CameraBasis basis = camera_basis(camera, width, height);
    Image mask(width, height, 1);
    for_each_pixel(width, height, [&](int x, int y) {
        const glm::vec2 center(float(x) + 0.5f, float(y) + 0.5f);
        Hit hit;
        const bool seen = rays.intersect(
            {camera.position, pixel_direction(basis, width, height, center), camera.near, camera.far}, hit);
        *mask.at(x, y) = seen ? 1.0f : 0.0f;
    });
    return mask;
}

Estimate render_reference(const RayCaster& rays, const ReferenceRequest& asked) {
    check(asked);
    ReferenceRequest request = asked;
    request.components = unique(asked.components);
    const ReferenceSettings& settings = request.settings;
    PathTracer tracer(rays, request);
    Film film(request.width, request.height, request.components);

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
    while (spp < settings.spp) {
        const int count = next_pass(settings, spp);
        for_each_pixel(request.width, request.height, [&](int x, int y) {
            tracer.trace_samples(x, y, spp, count,
                                 [&](int s, const PathSample& value) { film.add(x, y, s, value); });
        });
        spp += count;
        progress.update(double(spp) / settings.spp);
        if (seconds_since(last_save) > checkpoint_seconds) save();
        if (settings.seconds > 0.0f && seconds_since(start) >= settings.seconds) break;
        if (settings.error > 0.0f && relative_error(film.estimate(spp)) < settings.error) break;
    }
    save();
    progress.finish();

    Estimate estimate = film.estimate(spp);
    estimate.mask = surface_mask(rays, request.camera, request.width, request.height);
    if (!found.warning.empty()) estimate.warnings.push_back(found.warning);
    return estimate;
}

} // namespace luxel
