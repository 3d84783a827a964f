// SPDX-License-Identifier: MIT
// Wavefront OBJ with MTL to a Scene.
#pragma once
#include <filesystem>

#include "scene/load.h"
#include "scene/scene.h"

namespace luxel {

// One mesh for each object or group and material, in the file's units. MTL is older than physical shading; it
// is read as:
//   Kd, map_Kd       Lambertian albedo
//   Ks               specular weight and color of a dielectric of index 1.5
//   Ns               GGX alpha = sqrt(2 / (Ns + 2)), Beckmann's width for Blinn's exponent [Walter2007, sec. 5.2]
//   Ke, map_Ke       radiance of the front face
//   d or Tr below 1, illum 4, 6, 7   transmission with refraction by Ni
//   norm             tangent-space normal map
// Errors: Fault::bad_input, Fault::io.
Scene load_obj(const std::filesystem::path& path, const LoadOptions& options = {});

} // namespace luxel
