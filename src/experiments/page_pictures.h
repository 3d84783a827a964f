// SPDX-License-Identifier: MIT
// Which views' pictures the page holds: as many as keep it small enough to open.
#pragma once
#include <nlohmann/json.hpp>

#include "experiments/experiment.h"

namespace luxel {

inline constexpr std::size_t largest_page_pictures = std::size_t(24) << 20; // bytes, of all views

// Per scene, per view: as page_view() makes them, or null. Where not all fit, those evenly
// spread from the least gain of the best row to its largest.
nlohmann::ordered_json page_pictures(const ExperimentResult& result,
                                     std::size_t limit = largest_page_pictures);

} // namespace luxel
