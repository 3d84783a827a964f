// SPDX-License-Identifier: MIT
// Scenes made by code: known answers for tests, and something to light on a machine without files.
#pragma once
#include <functional>

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
// Cobbled floor and brick wall by height maps, under a low sun.
Scene relief();
// A tree, its leaves in blocks that are objects of their own, and a stone under the sun.
Scene tree();
// The closed box [-1, 1]^3 of six colors: either black walls emit their color, or eight lamps light them.
enum class BallLight { walls, lamps };
Scene color_room(BallLight light);
// In it a ball with the role "dynamic ball", `distance` times its diameter
// away from the face +x, from the edge to -y or from the corner to +z. Cameras: in the room, and from behind
// the wall +x onto the side that faces it.
enum class BallPlace { face, edge, corner };
Scene ball_room(BallPlace place, float distance, BallLight light);
// Replaces each triangle by 4^levels: same surface, more triangles.
Scene subdivide(const Scene& scene, int levels);

// What is specular in the scenes below has the role "specular NAME".
// Solid glass sphere above the floor of a room, under a spot light.
Scene glass_sphere();
// Mirroring ring on a floor, under a point light: a cardioid of light inside it.
Scene metal_ring();
// A pool whose surface has waves after `seconds`, under a spot light; a camera below the surface, one above.
Scene water(float seconds);
// Metal ring, glass sphere, mirror ball and an empty drinking glass in a room, under a point light.
Scene glass_metal();
// Mirror sphere in a closed box of painted walls.
Scene mirror_box();
// A mirroring pot with handle and spout, which sees itself, in the same box.
Scene teapot_box();

// After [Le2014, chapter 4], each in a room under one spot light, with the triangles of the thesis.
// 202: gold ring on the floor.
Scene ring();
// 214: the ring on a platform, four walls before it; light that falls through the platform is a tracer's
// leak.
Scene occluded_ring();
// 208 622: three diffuse solids of 69 452 triangles with head and ears, and a ring.
Scene bunnies_ring();
// 1932: shallow water on the floor of the room, `seconds` after the start.
Scene water_room(float seconds);
// A basin of 2 m x 2 m with water, on y = 0: to be placed in other scenes.
Scene pool(float seconds);

// Building blocks; all append to `mesh`.
void add_quad(Mesh& mesh, glm::vec3 corner, glm::vec3 edge_u, glm::vec3 edge_v); // front normal: cross(u, v)
void add_box(Mesh& mesh, glm::vec3 least, glm::vec3 most);                       // normals outward
void add_sphere(Mesh& mesh, glm::vec3 center, float radius, int slices, int stacks);
void add_cylinder(Mesh& mesh, glm::vec3 base, float radius, float height, int slices);
void add_cone(Mesh& mesh, glm::vec3 base, float radius, float height, int slices);
void add_torus(Mesh& mesh, glm::vec3 center, float ring_radius, float tube_radius, int slices, int stacks);

// A point of the outline that is revolved about the y axis, with the outline's normal there.
struct OutlinePoint {
    float radius, height;
    float normal_radial, normal_y;
};
// Revolves one smooth piece of outline about the vertical axis through `base`. The outline is walked with the
// outside on its right (bottom to top on an outer side), which makes the front face outward.
void add_revolved(Mesh& mesh, glm::vec3 base, const std::vector<OutlinePoint>& outline, int slices);
// A curve through (radius, height) points, `steps` pieces between neighbors, with its normals.
std::vector<OutlinePoint> smooth_outline(const std::vector<glm::vec2>& points, int steps);

// Height over (x, z), facing up; height(x, z) returns (y, dy/dx, dy/dz). cells x cells squares of the square
// around the origin of half the side `half`.
void add_height_field(Mesh& mesh, float half, int cells,
                      const std::function<glm::vec3(float x, float z)>& height);

} // namespace luxel
