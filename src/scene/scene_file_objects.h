// SPDX-License-Identifier: MIT
// The [[object]] tables of a scene file: roles and material changes for instances chosen by name.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/file.h"
#include "scene/scene.h"
#include "scene/scene_file_section.h"

namespace luxel {

struct ObjectRule {
    Section section; // for sentences
    std::string pattern;
    std::optional<std::string> role;
    std::optional<glm::vec3> base_color, emission, attenuation_color;
    std::optional<float> metallic, roughness, transmission, ior, attenuation_distance, clearcoat,
        clearcoat_roughness, height_scale;
    std::optional<bool> thin;
    std::optional<std::string> height_map;
    std::optional<Impostor> impostor;
    bool changes_material() const {
        return base_color || emission || attenuation_color || metallic || roughness || transmission || ior ||
               attenuation_distance || clearcoat || clearcoat_roughness || thin || height_map;
    }
};

ObjectRule read_object_rule(Section& section);

// In order, so that later rules win. Height maps are read beneath `folder`. Error Fault::bad_input: a pattern
// matches no instance, a height map cannot be read.
void apply_object_rules(Scene& scene, const std::vector<ObjectRule>& rules, const Folder& folder);

} // namespace luxel
