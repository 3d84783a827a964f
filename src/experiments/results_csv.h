// SPDX-License-Identifier: MIT
// results.csv: a line for every row of every view; docs/experiments.md names the columns.
#pragma once
#include <string>

#include "experiments/experiment.h"

namespace luxel {

std::string results_csv(const ExperimentResult& result);

} // namespace luxel
