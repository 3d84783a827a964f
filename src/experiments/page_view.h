// SPDX-License-Identifier: MIT
// One view's pictures as the page holds them.
#pragma once
#include <nlohmann/json.hpp>

#include "experiments/experiment.h"

namespace luxel {

// {reference, reference_bright?, rows: [{image, bright?, error, signed, flip, change}]} as data URIs of JPEGs
// at most `width` wide. `bright` is there where the display values are cut off at white.
nlohmann::ordered_json page_view(const ViewPictures& pictures, int width);

} // namespace luxel
