// SPDX-License-Identifier: MIT
// Wavefront OBJ with MTL to a Scene.
#pragma once
#include <filesystem>

#include "scene/load.h"
#include "scene/scene.h"

namespace luxel {

// One mesh for each object or group and material, in the file's units. MTL is
// older than physical shading; it is read as:
//   Kd, map_Kd       Lambertian albedo
//   Ks, map_Ks       specular weight and color of a dielectric of index 1.5
//   Ns               GGX alpha = sqrt(2 / (Ns + 2)), Beckmann's width for
//   Blinn's exponent [Walter2007, sec. 5.2] Pr, Pm, map_Pr, map_Pm   roughness
//   and metalness; then Kd is the base color, Ni the index, Ks has no say Pc,
//   Pcr          clearcoat and its roughness Ke, map_Ke       radiance of the
//   front face d or Tr below 1, illum 4, 6, 7   transmission with refraction by
//   Ni map_d            alpha mask, cut at one half norm tangent-space normal
//   map bump, map_bump   heights to normals: slopes of -bm times the difference
//   from texel to texel; a map that
//                    holds normals is read as such
// Corners without normals take those of their smoothing group, or of their face
// where it is off. What is left out is one counted warning. Errors:
// Fault::bad_input, Fault::io.
Scene load_obj(const std::filesystem::path& path, const LoadOptions& options = {});

} // namespace luxel
