// SPDX-License-Identifier: MIT
// Camera scripts: TOML files of [[camera]] tables, the same as in scene files, for use with any scene.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/scene_file_section.h"

namespace luxel {

// A camera of a file, before it is known which scene it is for.
struct PlacedCamera {
    Camera camera;       // but for its position
    glm::dvec3 position; // in the files' coordinates
    bool near_is_given;

    // In a scene of such a radius, whose coordinates begin at `origin`. Where the file names no near distance
    // it is small beside the scene: scenes may be of millimeters.
    Camera in_scene(const glm::dvec3& origin, float radius) const;
};

// One [[camera]] table; `number` names a camera that has no name.
PlacedCamera read_camera(Section& section, std::size_t number);

// At least one camera, for the scene. Errors: Fault::bad_input (with the line), Fault::io.
std::vector<Camera> load_camera_file(const std::filesystem::path& path, const Scene& scene);
// The same errors, for when no scene is loaded yet.
void check_camera_file(const std::filesystem::path& path);

// What load_camera_file reads back, within rounding of the angle, for cameras of a scene whose coordinates
// begin at `origin`; `comment` becomes its first line.
std::string camera_file_text(const std::vector<Camera>& cameras, const std::string& comment,
                             const glm::dvec3& origin = glm::dvec3(0.0));

} // namespace luxel
