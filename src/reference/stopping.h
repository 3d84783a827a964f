// SPDX-License-Identifier: MIT
// When a run has samples enough.
#pragma once

namespace luxel {

// The numbers of samples at which a run looks at its error: often enough that a run overshoots its target by
// 6 % of its samples, seldom enough that looking costs little, the same for every run, so that the clock has
// no say.
int next_look(int spp); // the first above spp
bool is_look(int spp);

} // namespace luxel
