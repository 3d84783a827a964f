// SPDX-License-Identifier: MIT
// Cameras and punctual lights of nodes.
#pragma once
#include <optional>

#include "scene/gltf/document.h"
#include "scene/load.h"
#include "scene/scene.h"

namespace luxel::gltf {

// Both without their position, which is the transform's last column in double precision. nullopt, with a
// warning: a camera that its node scales to nothing.
std::optional<Camera> read_camera(Document& document, const Value& node, const glm::dmat4& world);
shared::Light read_light(Document& document, const Value& node, const glm::dmat4& world, LightUnits units);

} // namespace luxel::gltf
