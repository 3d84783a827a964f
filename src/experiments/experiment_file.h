// SPDX-License-Identifier: MIT
// Experiment files: TOML, see docs/experiments.md.
#pragma once
#include <filesystem>

#include "experiments/experiment.h"

namespace luxel {

// Everything that can be known before a scene is loaded is checked: keys, techniques, parameters, the
// presence of files. `data`: the folder that paths beginning with "data:" are in; may be empty. Errors:
// Fault::bad_input (with the line), Fault::io.
Experiment load_experiment_file(const std::filesystem::path& file, const std::filesystem::path& data);

} // namespace luxel
