// SPDX-License-Identifier: MIT
#include "scene/roles.h"

#include <algorithm>

#include "shared/brdf.h"

namespace luxel {
namespace {

std::vector<SceneObject> objects_by_role(const Scene& scene, std::string_view prefix, bool by_material) {
    std::vector<SceneObject> objects;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        if (by_material && instance.role.empty() &&
            is_specular(scene.materials[std::size_t(mesh.material)])) {
            objects.push_back({"", {int(i)}});
            continue;
        }
        if (!instance.role.starts_with(prefix)) continue;
        auto same = std::find_if(objects.begin(), objects.end(),
                                 [&](const SceneObject& o) { return o.role == instance.role; });
        if (same == objects.end()) same = objects.insert(same, {instance.role, {}});
        same->instances.push_back(int(i));
    }
    return objects;
}

std::vector<bool> flags(const Scene& scene, const std::vector<SceneObject>& objects, bool inside) {
    std::vector<bool> drawn(scene.instances.size(), !inside);
    for (const SceneObject& object : objects)
        for (int i : object.instances) drawn[std::size_t(i)] = inside;
    return drawn;
}

} // namespace

bool is_specular(const Material& m) {
    const float transmission = m.transmission * (1.0f - m.metallic);
    return shared::signed_ior(m.metallic, m.roughness, transmission, m.ior, m.thin) != 0.0f;
}

bool has_specular_surface(const Scene& scene) {
    return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const Material& m = scene.materials[std::size_t(mesh.material)];
        // Textures are factors of at most 1.
        const float roughness = m.metallic_roughness_texture.texture >= 0 ? 0.0f : m.roughness;
        return shared::signed_ior(m.metallic, roughness, m.transmission, m.ior, m.thin) != 0.0f;
    });
}

std::vector<SceneObject> dynamic_objects(const Scene& scene) {
    return objects_by_role(scene, "dynamic", false);
}
std::vector<SceneObject> specular_objects(const Scene& scene) {
    return objects_by_role(scene, "specular", true);
}

std::vector<ImpostorObject> impostor_objects(const Scene& scene) {
    std::vector<ImpostorObject> objects;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (instance.impostor.kind == ImpostorKind::none) continue;
        auto same = objects.end();
        if (!instance.role.empty())
            same = std::find_if(objects.begin(), objects.end(), [&](const ImpostorObject& o) {
                return o.impostor == instance.impostor &&
                       scene.instances[std::size_t(o.instances[0])].role == instance.role;
            });
        if (same == objects.end())
            same = objects.insert(
                same, {instance.role.empty() ? instance.name : instance.role, instance.impostor, {}});
        same->instances.push_back(int(i));
    }
    return objects;
}

std::vector<bool> only(const Scene& scene, const std::vector<SceneObject>& objects) {
    return flags(scene, objects, true);
}
std::vector<bool> all_but(const Scene& scene, const std::vector<SceneObject>& objects) {
    return flags(scene, objects, false);
}

} // namespace luxel
