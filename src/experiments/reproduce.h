// SPDX-License-Identifier: MIT
// The statements of a thesis beside what is measured here.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "experiments/experiment_run.h"

namespace luxel {

struct Statement {
    std::string subject, claim, measured;
    std::vector<double> values; // the numbers in `measured`; empty: not measurable
    std::optional<bool> holds;  // of the sign or the order that is claimed; none: it claims a number alone,
                                // or the measurement decides nothing
};

struct Reproduction {
    std::string source; // what was run
    std::vector<Statement> statements;
    std::vector<std::string> remarks; // what differs from the thesis's setting
    std::vector<std::string> warnings;
};

struct ReproduceSettings {
    std::vector<std::string> scenes; // empty: built-in ones
    int views_per_scene = 2;         // 0: the scene's own cameras
    int width = 192, height = 144;
    int timed_frames = 5; // the rows take turns; fewer than 3 have no median to speak of
    TruthSettings truth;  // samples and seed; the rest is set here
    RunOptions run;       // device, cache, quiet
    std::string data;     // folder of what scene files call data:...
    bool strict = false;
};

// Image-space radiosity against direct light, in mode calibrated and in mode thesis [Rohleder2010, ch. 5].
Reproduction reproduce_rohleder_2010(const ReproduceSettings& settings);

// Ambient occlusion in screen space against ray-traced occlusion [Umenhoffer2009, ch. 4].
Reproduction reproduce_umenhoffer_2009_occlusion(const ReproduceSettings& settings);

// Diffuse environment mapping near a wall [Umenhoffer2009, ch. 3].
Reproduction reproduce_umenhoffer_2009_diffuse(const ReproduceSettings& settings);

// Rays through layered distance maps: steps of the search, and depth [Umenhoffer2009, ch. 5].
Reproduction reproduce_umenhoffer_2009_reflections(const ReproduceSettings& settings);

// What the resolutions of caustic triangles cost [Umenhoffer2009, ch. 6].
Reproduction reproduce_umenhoffer_2009_caustics(const ReproduceSettings& settings);

// Photons and virtual lights in image space [Le2014, ch. 4].
Reproduction reproduce_le_2014(const ReproduceSettings& settings);

std::string format_reproduction(const Reproduction& reproduction);

} // namespace luxel
