// SPDX-License-Identifier: MIT
#include "scene/gltf/camera_light.h"

#include <cmath>
#include <numbers>

namespace luxel::gltf {
namespace {

// The unit world direction of a node's axis; zero when the node is scaled to nothing.
glm::vec3 axis(const glm::dmat4& world, const glm::dvec3& local) {
    const glm::dvec3 v = glm::dmat3(world) * local;
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0.0f);
}

// Distances of a lens: beyond "zfar" nothing is seen, and without one everything is.
void read_depths(const Value& lens, Camera& camera) {
    camera.near = lens["znear"].number();
    camera.far = lens["zfar"].number(camera.far);
    const bool starts = camera.near > 0.0f || (camera.orthographic() && camera.near == 0.0f);
    if (!(starts && camera.near < camera.far)) lens.fail("znear and zfar do not enclose a depth range");
}

void read_perspective(const Value& lens, Camera& camera) {
    camera.yfov = lens["yfov"].number();
    if (!(camera.yfov > 0.0f && camera.yfov < std::numbers::pi_v<float>))
        lens["yfov"].fail("is not within 0 to pi");
    read_depths(lens, camera);
}

// The image's own shape decides how wide it is, as for "aspectRatio".
void read_orthographic(const Value& lens, Camera& camera) {
    camera.half_height = std::abs(lens["ymag"].number());
    if (!(camera.half_height > 0.0f)) lens["ymag"].fail("is 0");
    read_depths(lens, camera);
}

// From what the file has to W/sr and W/m2. Blender's exporter divides a lamp's watts by 4 pi, also those of a
// spot, unless it is told to write them as they are ("raw"), and then multiplies by 683 ("standard") or not
// ("unitless").
float factor_of(LightUnits units, shared::uint type) {
    constexpr float lumens_per_watt = 683.0f;
    if (units == LightUnits::watts) return 1.0f / lumens_per_watt;
    if (units == LightUnits::power && type != shared::LIGHT_DIRECTIONAL)
        return 0.25f * std::numbers::inv_pi_v<float>;
    return 1.0f;
}

} // namespace

std::optional<Camera> read_camera(Document& document, const Value& node, const glm::dmat4& world) {
    const Value json = document.resolve("cameras", node["camera"]);
    const std::string& type = json["type"].text();
    Camera camera;
    camera.name = printable(node["name"].text(json["name"].text("").c_str()));
    camera.forward = axis(world, {0, 0, -1});
    camera.up = axis(world, {0, 1, 0});
    if (type == "perspective")
        read_perspective(json["perspective"], camera);
    else if (type == "orthographic")
        read_orthographic(json["orthographic"], camera);
    else
        json["type"].fail("\"{}\" is not a camera type", printable(type));
    if (glm::length(glm::cross(camera.forward, camera.up)) < 1e-6f) {
        document.warn("a camera that is scaled to nothing is left out");
        return std::nullopt;
    }
    return camera;
}

shared::Light read_light(Document& document, const Value& node, const glm::dmat4& world, LightUnits units) {
    const Value lights = document.root()["extensions"]["KHR_lights_punctual"]["lights"];
    const Value reference = node["extensions"]["KHR_lights_punctual"]["light"];
    const Value json = lights.at(reference.index(lights.size(), "light"));
    const std::string& type = json["type"].text();

    shared::Light light{};
    light.direction = axis(world, {0, 0, -1});
    if (light.direction == glm::vec3(0.0f)) light.direction = {0, 0, -1};
    light.intensity = json["color"].vec<3>(glm::vec3(1.0f)) * json["intensity"].number(1.0f);
    if (glm::any(glm::lessThan(light.intensity, glm::vec3(0.0f))))
        json.fail("its color or intensity is negative");
    light.range = json["range"].number(0.0f);
    if (light.range < 0.0f) json["range"].fail("is negative");

    if (type == "directional")
        light.type = shared::LIGHT_DIRECTIONAL;
    else if (type == "point")
        light.type = shared::LIGHT_POINT;
    else if (type == "spot") {
        const Value cone = json["spot"];
        const float inner = cone["innerConeAngle"].number(0.0f);
        const float outer = cone["outerConeAngle"].number(std::numbers::pi_v<float> / 4.0f);
        if (!(inner >= 0.0f && inner <= outer && outer <= std::numbers::pi_v<float> / 2.0f + 1e-5f))
            json.fail("its cone angles are not 0 <= inner <= outer <= pi/2");
        light.type = shared::LIGHT_SPOT;
        light.inner = shared::versine(inner);
        light.outer = shared::versine(outer);
    } else {
        json["type"].fail("\"{}\" is not a light type", printable(type));
    }
    light.intensity *= factor_of(units, light.type);
    return light;
}

} // namespace luxel::gltf
