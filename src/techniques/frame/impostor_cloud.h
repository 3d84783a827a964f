// SPDX-License-Identifier: MIT
// Billboard clouds [Decoret2003]: planes with the triangles that they show, side by side in one image.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/roles.h"
#include "techniques/frame/frame.h"
#include "techniques/frame/impostor_params.h"

namespace luxel {

struct ImpostorCloud {
    // A plane's triangles of one instance in `indices`, which count from the mesh's first vertex.
    struct Part {
        int instance;
        std::uint32_t first, count;
    };
    std::vector<shared::ImpostorCard> cards;
    std::vector<shared::ViewParams> views; // of the cards; world_to_clip leads into the whole image
    std::vector<std::vector<Part>> parts;
    std::vector<std::uint32_t> indices;
    std::uint32_t width = 0, height = 0; // of the image, texels
};

// Errors: Fault::bad_input (a height map, a distance beyond the digits of a float), Fault::resource (too many
// texels).
ImpostorCloud make_cloud(const Scene& scene, const ImpostorObject& object);

// The rotation and translation by which all of an object's instances have moved; none where they moved apart,
// or changed their shape.
std::optional<glm::mat4> common_motion(const std::vector<glm::mat4>& before,
                                       const std::vector<glm::mat4>& after);
// The cards after such a motion; their samples stay.
std::vector<shared::ImpostorCard> moved(std::vector<shared::ImpostorCard> cards, const glm::mat4& motion);

// The samples of its cards; `direct` holds what they emit.
Capture draw_cloud(gpu::Recorder& recorder, const GpuScene& scene, const ImpostorObject& object,
                   const ImpostorCloud& cloud);

} // namespace luxel
