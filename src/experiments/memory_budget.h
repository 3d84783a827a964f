// SPDX-License-Identifier: MIT
// Memory planned before it is taken: a size that cannot fit is refused with a sentence, not by the system's
// killer.
#pragma once
#include <cstddef>

namespace luxel {

// Error Fault::resource when a view of this size with so many components (0: no path tracing) cannot fit.
void require_memory(int width, int height, std::size_t components);

} // namespace luxel
