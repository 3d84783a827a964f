// SPDX-License-Identifier: MIT
// POV-Ray's picture of a view in place of the path tracer's, as in [Rohleder2010, ch. 5].
#pragma once
#include <chrono>

#include "core/image.h"
#include "scene/export/povray/povray.h"

namespace luxel {

bool povray_installed();
void require_povray(); // error Fault::unsupported where it is not

// Radiance at pixel centers, direct light and, with settings.radiosity, one diffuse bounce; pixels without a
// surface hold the sky. Works in a temporary folder. Errors: Fault::unsupported (not installed),
// Fault::resource (the limit), Fault::bad_input (POV-Ray refuses the scene).
Image povray_radiance(const Scene& scene, const Camera& camera, int width, int height,
                      const PovraySettings& settings = {.specular = false},
                      std::chrono::seconds limit = std::chrono::hours(2));

} // namespace luxel
