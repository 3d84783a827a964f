// SPDX-License-Identifier: MIT
// Objects: what of a scene belongs together, by the roles and impostors that its scene file gives.
#pragma once
#include <string>
#include <vector>

#include "scene/scene.h"

namespace luxel {

struct SceneObject {
    std::string role;           // "" when the material alone makes it one
    std::vector<int> instances; // indices into Scene::instances, ascending
};

// Instances with the same role are one object where the role begins with "dynamic", in the order of their
// first instance.
std::vector<SceneObject> dynamic_objects(const Scene& scene);
// The same with "specular"; besides, every instance without a role whose material is smooth metal or
// transmits is an object of its own.
std::vector<SceneObject> specular_objects(const Scene& scene);
// By the material's factors, textures aside (shared::signed_ior).
bool is_specular(const Material& material);
// Whether textures could make a part of a surface of the scene so.
bool has_specular_surface(const Scene& scene);

// Instances that share an impostor: those of one role with equal settings; without a role each has its own.
struct ImpostorObject {
    std::string name; // the role, or the instance's name
    Impostor impostor;
    std::vector<int> instances; // ascending
};
std::vector<ImpostorObject> impostor_objects(const Scene& scene);

// What CaptureRequest::drawn takes: one entry per instance of the scene.
std::vector<bool> only(const Scene& scene, const std::vector<SceneObject>& objects);
std::vector<bool> all_but(const Scene& scene, const std::vector<SceneObject>& objects);

} // namespace luxel
