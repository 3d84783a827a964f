// SPDX-License-Identifier: MIT
// Surfaces that light passes without a bend, window panes and what is blended by its coverage, so that what
// is behind them can be lit along straight lines.
#pragma once
#include "scene/surface.h"

namespace luxel {

// Whether a share of the light goes straight through the glass of the surface: a thin and smooth sheet.
inline bool is_clear_sheet(const Surface& s) {
    return s.material->thin && s.transmission > 0.0f && s.roughness < shared::MIRROR_ROUGHNESS;
}
// Whether surfaces of the material may be so. (Textures only lessen transmission and roughness.)
inline bool may_be_clear_sheet(const Material& m) {
    return m.thin && m.transmission > 0.0f &&
           (m.roughness < shared::MIRROR_ROUGHNESS || m.metallic_roughness_texture.texture >= 0);
}

// Share of the light along `direction` that goes straight through the glass, by channel: the rest of what
// meets the surface is reflected, absorbed or scattered.
glm::vec3 sheet_transmittance(const Surface& surface, glm::vec3 direction);
// The same with what is not covered, of alpha-blended surfaces.
glm::vec3 straight_transmittance(const Surface& surface, glm::vec3 direction);

} // namespace luxel
