// SPDX-License-Identifier: MIT
// Results as text for a terminal.
#pragma once
#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace luxel {

// Columns as wide as their widest cell; the first is flush left, the others right.
std::string format_table(const std::vector<std::vector<std::string>>& cells);

// The mean over views, what many views say together, and with `verbose` each view and the time by pass.
std::string format_result(const ExperimentResult& result, bool verbose);

} // namespace luxel
