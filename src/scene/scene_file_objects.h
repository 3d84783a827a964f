// SPDX-License-Identifier: MIT
// The [[object]] tables of a scene file: roles and material changes for instances chosen by name.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/scene_file_section.h"

namespace luxel {

struct ObjectRule {
    Section section; // for sentences
    std::string pattern;
    std::optional<std::string> role;
    std::optional<glm::vec3> base_color, emission;
    std::optional<float> metallic, roughness, transmission, ior;
    bool changes_material() const {
        return base_color || emission || metallic || roughness || transmission || ior;
    }
};

ObjectRule read_object_rule(Section& section);

// In order, so that later rules win. Error Fault::bad_input: a pattern matches no instance.
void apply_object_rules(Scene& scene, const std::vector<ObjectRule>& rules);

} // namespace luxel
