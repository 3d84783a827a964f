// SPDX-License-Identifier: MIT
// Mip levels of textures that blits would spoil: those of 16 bits and those of alpha masks.
#pragma once
#include <optional>
#include <vector>

#include "core/image.h"
#include "scene/scene.h"

namespace luxel {

// RGBA levels 0 to the last, linear colors, by exact means over each texel's area: of odd sizes, too. Numbers
// keep alpha as it is stored.
//
// Of an alpha mask, level 0 has the alpha of the file, which is held against the cutoff. From level 1 on
// alpha is coverage: the share of the texel's area where the bilinear filter of level 0 reaches the cutoff;
// color is the mean over what is covered, so that what holes hide does not bleed out of them.
std::vector<Image> texture_levels(const Texture& texture, std::optional<float> cutoff);

// The next smaller level.
Image half_size(const Image& level);

} // namespace luxel
