// SPDX-License-Identifier: MIT
#include "experiments/judge.h"

#include <algorithm>
#include <chrono>

#include "core/error.h"
#include "experiments/povray_judge.h"
#include "reference/content_key.h"

namespace luxel {

namespace {

constexpr std::uint32_t povray_version = 1; // raised with every change of what POV-Ray is given
constexpr const char* povray_layer = "povray";

Truth render_povray(const RayCaster& rays, const ViewTask& task, const PovraySettings& settings) {
    const auto start = std::chrono::steady_clock::now();
    Truth truth;
    truth.mean[povray_layer] = povray_radiance(rays.scene(), task.camera, task.width, task.height, settings);
    truth.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    truth.spp = 1;
    truth.mask = surface_mask(rays, task.camera, task.width, task.height);
    return truth;
}

// The path tracer's samples and seed do not matter.
std::string povray_key(const Scene& scene, const ViewTask& task, const PovraySettings& settings) {
    ContentKey key;
    key.add(std::string_view(reference_key(scene, reference_request({.spp = 1, .seed = 1}, task))));
    key.add(povray_version);
    for (int value :
         {int(settings.radiosity), int(settings.specular), settings.area_lights, settings.environment_lights})
        key.add(value);
    return fmt::format("{:016x}", key.value());
}

} // namespace

bool povray_judges(const std::vector<std::string>& components) {
    std::vector<std::string> sorted = components;
    std::sort(sorted.begin(), sorted.end());
    return sorted == std::vector<std::string>{"direct"} ||
           sorted == std::vector<std::string>{"diffuse1", "direct"};
}

void require_judge(const TruthSettings& truth) {
    if (truth.judge == Judge::povray) require_povray();
}

std::vector<std::string> judged_layers(const TruthSettings& truth) {
    if (truth.judge == Judge::povray) return {povray_layer};
    return truth.components;
}

Truth judge_view(const RayCaster& rays, const TruthSettings& truth, const ViewTask& task,
                 const std::filesystem::path& cache, std::vector<std::string>& warnings,
                 const TruthWatch& watch) {
    if (truth.judge == Judge::reference)
        return find_truth(rays, reference_request(truth, task), cache, warnings, watch);
    LUXEL_ASSERT(povray_judges(truth.components), "components={}", truth.components.size());
    const PovraySettings settings = {.radiosity = truth.components.size() > 1, .specular = false};
    return find_truth(povray_key(rays.scene(), task, settings), cache, warnings,
                      [&] { return render_povray(rays, task, settings); });
}

std::optional<Truth> early_truth(const RayCaster& rays, const TruthSettings& truth, const ViewTask& task,
                                 int samples, const std::filesystem::path& cache,
                                 std::vector<std::string>& warnings) {
    if (truth.judge != Judge::reference || cache.empty()) return std::nullopt;
    return find_truth(rays, reference_request(truth, task), cache, warnings,
                      [&](int spp) { return spp < samples; });
}

} // namespace luxel
