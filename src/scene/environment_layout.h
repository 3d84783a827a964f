// SPDX-License-Identifier: MIT
// Environment maps that are not equirectangular: cubes, unfolded to a cross or a strip.
#pragma once
#include <string>

#include "core/image.h"

namespace luxel {

// What the shape of a picture says. Crosses have six unused cells, each of one color; without those a picture
// of 4:3 or 3:4 is `other`. Squares may be mirror balls or angular maps, which nothing tells apart.
enum class MapLayout { equirectangular, cross_4x3, cross_3x4, strip_6x1, strip_1x6, square, other };
MapLayout layout_of(const Image& picture);
std::string describe(MapLayout layout); // as a noun

// A cube as an equirectangular map of four faces' width, as Environment has it. Faces are pictures seen from
// the inside. The one in the middle of a cross (the lower middle of 3:4) becomes the middle of the map, the
// back of 3:4 stands upside down below; strips have right, left, top, bottom, front, back, as OpenGL counts
// its faces.
Image equirectangular(const Image& cube, MapLayout layout);

} // namespace luxel
