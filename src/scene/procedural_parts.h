// SPDX-License-Identifier: MIT
// What the procedural scenes are put together from: materials, objects, cameras, lamps, rooms.
#pragma once
#include <string>

#include "scene/procedural.h"

namespace luxel::procedural {

float radians(float degrees);

// Purely diffuse: no metal and no specular lobe, so the albedo is exactly `albedo`.
Material lambertian(const std::string& name, glm::vec3 albedo, glm::vec3 emission = glm::vec3(0.0f));
// Ideal ones.
Material mirror(const std::string& name, glm::vec3 reflectance);
Material glass(const std::string& name, float ior);

// Adds an object of its own material; the mesh is then filled by the building blocks.
Mesh& add_object(Scene& scene, const Material& material);
Mesh& add_specular_object(Scene& scene, const Material& material); // with its role
void add_quad_object(Scene& scene, const Material& material, glm::vec3 corner, glm::vec3 edge_u,
                     glm::vec3 edge_v);

// Walls of the cube x [-1, 1], y [0, 2], z [-1, 1] that face inward, the side toward +z left open.
void add_open_room(Scene& scene, const Material& floor, const Material& ceiling, const Material& back,
                   const Material& left, const Material& right);
// The same in light gray, the left wall red and the right one green.
void add_gray_room(Scene& scene);

// A band that stands on y = base.y: two cylinders, joined by flat rims; 8 triangles a slice.
void add_ring(Mesh& mesh, glm::vec3 base, float inner, float outer, float height, int slices);

// Deep-water waves of four lengths; each bends the surface as much as the others.
struct Waves {
    float level, curvature; // m, 1/m
    float lengths[4];       // m
};
glm::vec3 wave_height(const Waves& waves, float x, float z, float seconds); // and its slopes along x and z

Camera camera_at(glm::vec3 position, glm::vec3 target, float yfov_degrees);
shared::Light point_light(glm::vec3 position, float intensity);
shared::Light spot_light(glm::vec3 position, glm::vec3 target, float intensity, float inner_degrees,
                         float outer_degrees);

} // namespace luxel::procedural
