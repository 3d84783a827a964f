// SPDX-License-Identifier: MIT
// Test only: what an object in a room of glowing walls receives, in closed form.
#pragma once
#include "scene/scene.h"
#include "support/box_quads.h"
#include "techniques/frame/projection.h"
#include "techniques/frame/renderer.h"

namespace luxel::testing {

// Errors of envmap's light on the object that the glowing walls of ball_room surround, against the
// closed form of its six walls without occlusion, over the mean of that.
struct Errors {
    double rms = 0, most = 0;
};
inline Errors errors_in_glowing_room(const Scene& scene, const RenderResult& result, std::size_t camera) {
    const Image &light = result.images.at("envmap radiance"), &depth = result.images.at("depth"),
                &normal = result.images.at("normal");
    const shared::ViewParams view = view_params(scene.cameras[camera], light.width, light.height);
    double squares = 0, truth = 0, pixels = 0;
    Errors e;
    for (int y = 0; y < light.height; ++y)
        for (int x = 0; x < light.width; ++x) {
            if (light.at(x, y)[3] == 0.0f) continue; // not of the object
            const glm::vec3 position = world_position(view, glm::vec2(x, y) + 0.5f, *depth.at(x, y));
            const glm::vec3 n = glm::normalize(normal.rgb(x, y));
            double expected = 0;
            for (int wall = 0; wall < 6; ++wall)
                expected += double(scene.materials[std::size_t(wall)].emission.g) *
                            lambert_irradiance(wall_quad(wall, 1, 0, 0, position), n);
            expected *= double(scene.materials[6].base_color.g) / double(shared::PI);
            const double d = std::abs(double(light.at(x, y)[1]) - expected);
            squares += d * d, truth += expected, e.most = std::max(e.most, d), ++pixels;
        }
    truth /= pixels;
    return {std::sqrt(squares / pixels) / truth, e.most / truth};
}

} // namespace luxel::testing
