// SPDX-License-Identifier: MIT
#include "scene/procedural_parts.h"

#include <cmath>

namespace luxel::procedural {

float radians(float degrees) { return degrees * (shared::PI / 180.0f); }

Material lambertian(const std::string& name, glm::vec3 albedo, glm::vec3 emission) {
    Material material;
    material.name = name;
    material.base_color = glm::vec4(albedo, 1.0f);
    material.metallic = 0.0f;
    material.specular = 0.0f;
    material.emission = emission;
    return material;
}

Material mirror(const std::string& name, glm::vec3 reflectance) {
    Material material;
    material.name = name;
    material.base_color = glm::vec4(reflectance, 1.0f);
    material.metallic = 1.0f;
    material.roughness = 0.0f;
    return material;
}

Material glass(const std::string& name, float ior) {
    Material material;
    material.name = name;
    material.metallic = material.roughness = 0.0f;
    material.transmission = 1.0f;
    material.thin = false;
    material.ior = ior;
    return material;
}

Mesh& add_object(Scene& scene, const Material& material) {
    scene.materials.push_back(material);
    Mesh mesh;
    mesh.name = material.name;
    mesh.material = int(scene.materials.size() - 1);
    scene.meshes.push_back(std::move(mesh));
    Instance instance;
    instance.name = material.name;
    instance.mesh = int(scene.meshes.size() - 1);
    scene.instances.push_back(std::move(instance));
    return scene.meshes.back();
}

Mesh& add_specular_object(Scene& scene, const Material& material) {
    Mesh& mesh = add_object(scene, material);
    scene.instances.back().role = "specular " + material.name;
    return mesh;
}

void add_quad_object(Scene& scene, const Material& material, glm::vec3 corner, glm::vec3 edge_u,
                     glm::vec3 edge_v) {
    add_quad(add_object(scene, material), corner, edge_u, edge_v);
}

void add_open_room(Scene& scene, const Material& floor, const Material& ceiling, const Material& back,
                   const Material& left, const Material& right) {
    const glm::vec3 x(2, 0, 0), y(0, 2, 0), z(0, 0, 2);
    add_quad_object(scene, floor, {-1, 0, -1}, z, x);
    add_quad_object(scene, ceiling, {-1, 2, -1}, x, z);
    add_quad_object(scene, back, {-1, 0, -1}, x, y);
    add_quad_object(scene, left, {-1, 0, -1}, y, z);
    add_quad_object(scene, right, {1, 0, -1}, z, y);
}

void add_gray_room(Scene& scene) {
    add_open_room(scene, lambertian("floor", glm::vec3(0.7f)), lambertian("ceiling", glm::vec3(0.7f)),
                  lambertian("back wall", glm::vec3(0.7f)), lambertian("left wall", {0.63f, 0.065f, 0.05f}),
                  lambertian("right wall", {0.14f, 0.45f, 0.091f}));
}

void add_ring(Mesh& mesh, glm::vec3 base, float inner, float outer, float height, int slices) {
    add_revolved(mesh, base, {{outer, 0, 1, 0}, {outer, height, 1, 0}}, slices);
    add_revolved(mesh, base, {{outer, height, 0, 1}, {inner, height, 0, 1}}, slices);
    add_revolved(mesh, base, {{inner, height, -1, 0}, {inner, 0, -1, 0}}, slices);
    add_revolved(mesh, base, {{inner, 0, 0, -1}, {outer, 0, 0, -1}}, slices);
}

glm::vec3 wave_height(const Waves& waves, float x, float z, float seconds) {
    constexpr float gravity = 9.81f, directions[] = {0.4f, 2.1f, -1.0f, 1.2f};
    glm::vec3 result(waves.level, 0, 0);
    for (int i = 0; i < 4; ++i) {
        const float k = 2.0f * shared::PI / waves.lengths[i], amplitude = waves.curvature / (k * k);
        const float kx = k * std::cos(directions[i]), kz = k * std::sin(directions[i]);
        const float phase = kx * x + kz * z - std::sqrt(gravity * k) * seconds + float(i);
        const float slope = -amplitude * std::sin(phase);
        result += glm::vec3(amplitude * std::cos(phase), kx * slope, kz * slope);
    }
    return result;
}

Camera camera_at(glm::vec3 position, glm::vec3 target, float yfov_degrees) {
    Camera camera;
    camera.name = "camera";
    camera.position = position;
    camera.forward = glm::normalize(target - position);
    camera.yfov = radians(yfov_degrees);
    return camera;
}

shared::Light point_light(glm::vec3 position, float intensity) {
    shared::Light light{};
    light.type = shared::LIGHT_POINT;
    light.position = position;
    light.intensity = glm::vec3(intensity);
    return light;
}

shared::Light spot_light(glm::vec3 position, glm::vec3 target, float intensity, float inner_degrees,
                         float outer_degrees) {
    shared::Light light = point_light(position, intensity);
    light.type = shared::LIGHT_SPOT;
    light.direction = glm::normalize(target - position);
    light.inner = shared::versine(radians(inner_degrees));
    light.outer = shared::versine(radians(outer_degrees));
    return light;
}

} // namespace luxel::procedural
