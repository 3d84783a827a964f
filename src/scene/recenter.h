// SPDX-License-Identifier: MIT
// Scenes far from their origin. Single precision keeps 24 bits of a coordinate: 6 cm at 1000 km. So such
// scenes are moved to the origin, and Scene::origin tells where they were.
#pragma once
#include "scene/scene.h"

namespace luxel {

struct DoubleBounds {
    glm::dvec3 least{1e300}, most{-1e300};
    void add(const glm::dvec3& p) { // what is not finite bounds nothing
        if (glm::any(glm::isnan(p)) || glm::any(glm::isinf(p))) return;
        least = glm::min(least, p), most = glm::max(most, p);
    }
    // The box of the transformed box.
    void add(const Bounds& box, const glm::dmat4& transform);
    bool empty() const { return least.x > most.x; }
};

// What to subtract: 0, but for bounds whose middle is many times their size away; there a multiple of a power
// of two near the middle, which positions of the files' precision lose nothing by.
glm::dvec3 origin_of(const DoubleBounds& bounds);

// Makes `origin` the scene's: instances, lights and cameras keep their places in the files' coordinates.
void move_origin(Scene& scene, const glm::dvec3& origin);

// Moves far vertices of each mesh to its middle and the scene to its own, for readers that know neither.
void recenter(Scene& scene);

// Moves the mesh's far vertices to its middle and returns where that is, or 0.
glm::dvec3 recenter(Mesh& mesh);

} // namespace luxel
