// SPDX-License-Identifier: MIT
// Sums of light-path components as typed on the command line: "direct+diffuse1", "full".
#pragma once
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"

namespace luxel {

// Error Fault::usage: unknown name (the known are listed), or parts that would count the same light twice.
std::vector<std::string> parse_components(std::string_view text);

// Those of the components that no other of them contains.
std::vector<std::string> without_parts(const std::set<std::string>& components);

// Whether the truth is occlusion: one channel, 1 = open, instead of light.
bool is_accessibility(const std::vector<std::string>& components);

// Sum of the named layers; every name must be there.
Image sum_of(const Layers& layers, const std::vector<std::string>& components);

} // namespace luxel
