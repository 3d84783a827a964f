// SPDX-License-Identifier: MIT
// POV-Ray's scene language.
#pragma once
#include <string>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include "scene/export/output.h"
#include "scene/export/povray/povray.h"
#include "scene/scene.h"

namespace luxel::povray {

struct Export : ExportOutput {
    const PovraySettings& settings;
};

inline std::string vector(glm::vec3 v) { return fmt::format("<{:.7g},{:.7g},{:.7g}>", v.x, v.y, v.z); }
inline std::string rgb(glm::vec3 c) { return "rgb " + vector(c); }

// #declare T<index> for a material of meshes without vertex colors.
void declare_material(Export& out, std::size_t index);
// What follows "texture" for one plain color of the Lambertian lobe.
std::string texture_of(const Export& out, const Material& material, glm::vec3 diffuse);
// Albedo of the Lambertian lobe with the textures read at `uv` (already transformed); alpha cut to 0 or 1.
glm::vec4 diffuse_albedo(const Scene& scene, const Material& material, glm::vec2 uv, glm::vec4 vertex_color);
std::string interior_of(const Export& out, const Material& material);

// #declare M<index> = mesh2.
void declare_mesh(Export& out, std::size_t index);

void add_lights(Export& out);
void add_sky(Export& out); // visible, but no source of light: add_lights() samples it

} // namespace luxel::povray
