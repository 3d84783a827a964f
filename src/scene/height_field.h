// SPDX-License-Identifier: MIT
// Height maps as geometry: what per-pixel displacement approximates, for renderers that know triangles only.
#pragma once
#include "scene/scene.h"
#include "shared/height_field.h"

namespace luxel {

// The material's height map; coordinates are those of its texture, after the use's transform.
shared::HeightField height_field(const Scene& scene, const Material& material);

// The scene with every instance of a material with a height map replaced by its tessellation: vertices moved
// along the shading normal by up to height_scale. A material without a normal map gets the relief's own
// normals; with one, that map stays to say them. No edge of theirs is longer than `edge` meters on the flat
// surface; 0: their legs are as long as a texel of the height map. Error Fault::resource: more than
// max_relief_triangles.
inline constexpr std::uint64_t max_relief_triangles = std::uint64_t(16) << 20;
Scene with_height_fields(const Scene& scene, float edge = 0.0f);
bool has_height_fields(const Scene& scene);

} // namespace luxel
