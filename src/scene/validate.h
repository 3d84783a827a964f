// SPDX-License-Identifier: MIT
// The last gate before a scene is used: whatever made it, code behind this point may rely on scene.h's
// promises.
#pragma once
#include <string>

#include "scene/scene.h"

namespace luxel {

// Larger coordinates overflow when squared in single precision.
inline constexpr float max_coordinate = 1e18f;

// Every index in range, every array as long as its mesh's vertices, every number finite and in its range,
// every transform invertible and affine, at least one triangle. Error Fault::bad_input "source: place:
// reason".
void validate_scene(const Scene& scene, const std::string& source);

} // namespace luxel
