// SPDX-License-Identifier: MIT
// What is seen from a point in all directions, with distances: light, normals and materials in cube maps,
// layer behind layer [Umenhoffer2009, 2.3.2, 3.1, 5.2].
//
// Storage: real cube images of 6 layers per capture, one image for each quantity. A direction is then one
// look-up, filtered across edges without seams (measured on lavapipe: 3e-5 of a wall's distance); the layers
// behind one another make a cube array, whose index may be dynamic where an array of samplers' may not. The
// distance has an image of its own, since searches read nothing else, many times. shared/cube.h says which
// texel is which direction.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "techniques/frame/frame.h"

namespace luxel {

// What `radiance` holds: all direct light, emission included, and the environment where nothing is seen; or
// what the Lambertian lobe reflects of direct light, and nothing else.
enum class CubeLight { all, diffuse };

struct CubeLayer {
    std::vector<bool> drawn; // by the scene's instances (scene/roles.h); empty: all
    Sides sides = Sides::standard;
    bool behind = false;             // only what is farther than the layer before
    std::optional<glm::vec3> center; // instead of the request's
    bool lit = true;                 // false: `radiance` holds what surfaces emit, and costs no shadow maps
};

struct CubeRequest {
    glm::vec3 center{0.0f};
    int size = 256; // texels a side, a power of two
    std::vector<CubeLayer> layers = {{}};
    CubeLight light = CubeLight::all;
    bool indirect = false; // lit layers also show what else lights them: Frame::add_indirect
    bool min_max = false;  // the pyramid of nearest and farthest distances
    float background =
        0.0f;           // distance where nothing is seen; 0: 100 times that of the scene's farthest corner
    std::string prefix; // of the images' names
};

// 6 faces for each layer of the request. A single layer can be bound as samplerCube and, as several can, as
// samplerCubeArray.
struct DistanceCube {
    glm::vec3 center{0.0f};
    int size = 0, layers = 0;
    float background = 0.0f;
    gpu::Image radiance; // RGBA32F, a = 1 where a surface is seen; mips are averages
    gpu::Image normal; // RGBA16F: world shading normal of the front, also where the back is seen; a = 1 where
                       // a surface is seen
    gpu::Image material; // RGBA16F: a = 0: rgb = albedo of the Lambertian lobe. a < 0, reflector, or a > 0,
                         // refractor: rgb = reflectance at normal incidence, |a| = index of refraction, 1 for
                         // what does not bend light
    gpu::Image distance; // R32F: |p - center|, m; mips are averages
    gpu::Image min_max;  // RG32F pyramid of `distance`; empty unless asked for

    DistanceCube layer(int index) const; // alone
};

// Every shadow map of the frame's lights is drawn once for all faces and layers.
DistanceCube capture_cube(gpu::Recorder& recorder, const Frame& frame, const CubeRequest& request);

// `count` layers of the same instances, by depth peeling, nearest first; backs included.
std::vector<CubeLayer> peeled_layers(const std::vector<bool>& drawn, int count, bool lit = true);
// Two layers: the nearest front sides, and the nearest back sides [Umenhoffer2009, 5.3].
std::vector<CubeLayer> face_layers(const std::vector<bool>& drawn, bool lit = true);

// Meters from a point to the farthest corner of a box, at least .001; 1 where it is empty.
float farthest_corner(const Bounds& box, glm::vec3 from);

// The camera of a face. Its pixel (x, y) is the texel (size - 1 - x, y): cube faces are mirrored as seen
// from inside.
shared::ViewParams cube_face_view(glm::vec3 center, int face, int size, float near, float far);

} // namespace luxel
