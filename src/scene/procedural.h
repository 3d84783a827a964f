// SPDX-License-Identifier: MIT
// Scenes made by code: known answers for tests, and something to light on a machine without files.
#pragma once
#include "scene/scene.h"

namespace luxel {

// Closed box [-1, 1]^3, every face emitting `emission` and reflecting `albedo`: radiance is emission/(1 -
// albedo).
Scene furnace(float albedo, float emission = 1.0f);
// The Cornell box in meters (2 m wide), one-sided area light under the ceiling, every material Lambertian.
Scene cornell();
// Five shapes on a floor [Sherif2013, fig. 7.22] under point, spot or directional light ("shapes-point",
// ...).
enum class ShapesLight { point, spot, directional };
Scene shapes(ShapesLight light);
// Sphere inside a box of differently colored walls.
Scene sphere_in_box();
// Replaces each triangle by 4^levels: same surface, more triangles.
Scene subdivide(const Scene& scene, int levels);

// Building blocks; all append to `mesh`.
void add_quad(Mesh& mesh, glm::vec3 corner, glm::vec3 edge_u, glm::vec3 edge_v); // front normal: cross(u, v)
void add_box(Mesh& mesh, glm::vec3 least, glm::vec3 most);                       // normals outward
void add_sphere(Mesh& mesh, glm::vec3 center, float radius, int slices, int stacks);
void add_cylinder(Mesh& mesh, glm::vec3 base, float radius, float height, int slices);
void add_cone(Mesh& mesh, glm::vec3 base, float radius, float height, int slices);
void add_torus(Mesh& mesh, glm::vec3 center, float ring_radius, float tube_radius, int slices, int stacks);

} // namespace luxel
