// SPDX-License-Identifier: MIT
// A frame's images by name, on the CPU and flat: for people to look at, and for tests.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"
#include "gpu/gpu.h"

namespace luxel {

// "NAME", "NAME:mip=2", "NAME:layer=5,mip=1": the last image of that name among `made`. Without a layer all
// of them, unrolled. Error Fault::usage: no such image (the known are listed), mip or layer.
Image read_named_image(gpu::Gpu& gpu, const std::vector<gpu::Image>& made, std::string_view text);

// Layers of one size side by side, in rows, as nearly square as it goes. With `cubes` each six of them are
// one cross whose inner edges meet as the cube's do:
//        +y
//     -x +z +x -z
//        -y
Image unrolled(const std::vector<Image>& layers, bool cubes);

} // namespace luxel
