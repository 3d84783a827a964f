// SPDX-License-Identifier: MIT
// Export to POV-Ray 3.7: the same light in another renderer's conventions; see docs/export.md.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace luxel {

struct PovraySettings {
    bool radiosity = true;       // one diffuse bounce, with the settings of [Rohleder2010, ch. 5]
    bool specular = true;        // mirrors and glass; without: the Lambertian lobe of every material alone
    int area_lights = 64;        // samples of the emissive meshes
    int environment_lights = 64; // samples of the environment
};

// The scene description and, beside it, the textures it refers to ("STEM-3.png", "STEM-sky.exr"). Returns
// what is only approximated, one sentence each; the same stands in the file as comments. Error Fault::io.
std::vector<std::string> write_povray(const std::filesystem::path& file, const Scene& scene,
                                      const Camera& camera, int width, int height,
                                      const PovraySettings& settings = {});

} // namespace luxel
