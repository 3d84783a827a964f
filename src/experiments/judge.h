// SPDX-License-Identifier: MIT
// The truth of a view by the judge that the settings name: the path tracer, or POV-Ray as in
// [Rohleder2010, ch. 5].
#pragma once
#include "experiments/evaluation.h"

namespace luxel {

// Whether POV-Ray can render that sum of light paths: direct light, with or without one diffuse bounce.
bool povray_judges(const std::vector<std::string>& components);

// Error Fault::unsupported where the judge is not on this machine.
void require_judge(const TruthSettings& truth);

// The layers of Truth::mean whose sum is the truth.
std::vector<std::string> judged_layers(const TruthSettings& truth);

// Rendered, or found in `cache` (empty: none). POV-Ray's picture has no sample groups: nothing is known of
// its noise, so that figures are those of the picture as it is.
Truth judge_view(const RayCaster& rays, const TruthSettings& truth, const ViewTask& task,
                 const std::filesystem::path& cache, std::vector<std::string>& warnings,
                 const TruthWatch& watch = {});

// At least `samples` of the path tracer's samples, or more where they are there already; judge_view goes on
// from them. Nothing without a cache, and of POV-Ray.
std::optional<Truth> early_truth(const RayCaster& rays, const TruthSettings& truth, const ViewTask& task,
                                 int samples, const std::filesystem::path& cache,
                                 std::vector<std::string>& warnings);

} // namespace luxel
