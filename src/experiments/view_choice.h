// SPDX-License-Identifier: MIT
// Which cameras a run looks through, each with a name of its own.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "scene/raycast.h"
#include "scene/scene.h"

namespace luxel {

struct ViewChoice {
    std::string file; // a camera script instead of the scene's cameras; empty = none
    int drawn = 0;    // > 0: that many views drawn by seed instead
    std::uint32_t seed = 1;
    std::vector<std::string> names; // only these: names, or numbers from 0; empty = all
};

// Names are unique and never empty. Error Fault::usage for a view that is not there (the known are listed).
std::vector<Camera> choose_views(const RayCaster& rays, const ViewChoice& choice);
// The same where no ray caster is at hand: one is built only where views are drawn.
std::vector<Camera> choose_views(const Scene& scene, const ViewChoice& choice);

// Gives each a name of its own, also as a file name: "view0" where there is none, "a-2" for a second "a".
void make_names_unique(std::vector<Camera>& cameras);

// Letters, digits, "-", "_", "." kept, everything else "_"; never empty, never hidden.
std::string file_name_of(const std::string& name);

} // namespace luxel
