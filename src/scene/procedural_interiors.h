// SPDX-License-Identifier: MIT
// Rooms as people build them, in which techniques meet what ruins them: light that comes in by small
// openings, lamps in housings, rows of furniture, and things behind glass.
#pragma once
#include "scene/scene.h"

namespace luxel {

// A bulb in an opaque shade that is open above and below, in a room.
Scene lamp_room();
// Rows of desks and chairs beside a wall of windows without panes, under sun and sky.
Scene classroom();
// A room with panes of thin glass in two walls, a sofa and a table, under sun and sky.
Scene glazed_room();
// A diffuse torus in a solid block of glass on a floor, under a spot light.
Scene torus_in_glass();

} // namespace luxel
