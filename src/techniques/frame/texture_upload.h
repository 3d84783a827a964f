// SPDX-License-Identifier: MIT
// Textures on the GPU.
#pragma once
#include <optional>

#include "gpu/gpu.h"
#include "scene/scene.h"

namespace luxel {

// 8 bits stay as they are. 16 bits keep them: as such where the device filters them, else, and for colors, in
// 32-bit floats. cutoff: of an alpha mask, whose mips hold coverage (texture_levels.h).
gpu::Image upload_texture(gpu::Gpu& gpu, const Texture& texture, bool mipmaps, std::optional<float> cutoff);

} // namespace luxel
