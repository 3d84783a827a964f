// SPDX-License-Identifier: MIT
#include "scene/thin_sheets.h"

#include "shared/thin_sheet.h"

namespace luxel {

glm::vec3 sheet_transmittance(const Surface& s, glm::vec3 direction) {
    if (!is_clear_sheet(s)) return glm::vec3(0.0f);
    const float cosine = glm::dot(s.normal, glm::normalize(direction));
    return s.transmission * s.glass_gain *
           shared::thin_transmittance(cosine, s.material->ior, s.specular * s.specular_color, s.base_color);
}

glm::vec3 straight_transmittance(const Surface& s, glm::vec3 direction) {
    return (1.0f - s.coverage) + s.coverage * sheet_transmittance(s, direction);
}

} // namespace luxel
