// SPDX-License-Identifier: MIT
// Cameras from and to TOML.
#include "scene/camera_file.h"

#include <algorithm>
#include <cmath>

#include "scene/printable.h"
#include "shared/sampling.h"

namespace luxel {
namespace {

// A basic string of TOML: whatever could end it or the line is escaped.
std::string quoted(const std::string& name) {
    std::string text = "\"";
    for (const char c : printable(name, longest_path)) {
        if (c == '"' || c == '\\') text += '\\';
        text += c;
    }
    return text + "\"";
}

std::string array(glm::vec3 v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

// Shortest numbers that read back as the same position.
std::string place(const Camera& camera, const glm::dvec3& origin) {
    if (origin == glm::dvec3(0.0)) return array(camera.position);
    const glm::dvec3 p = origin + glm::dvec3(camera.position);
    return fmt::format("[{}, {}, {}]", p.x, p.y, p.z);
}

std::string lens(const Camera& camera) {
    if (camera.orthographic()) return fmt::format("orthographic_height = {}", camera.half_height * 2.0f);
    return fmt::format("yfov_degrees = {:.9g}", double(camera.yfov) * 180.0 / double(shared::PI));
}

std::vector<PlacedCamera> read_cameras(const std::filesystem::path& path) {
    const toml::table table = parse_toml(path);
    Section top(table, path.string(), "");
    std::vector<Section> sections = top.sections("camera");
    top.finish();
    if (sections.empty()) top.reject("camera", "there is no [[camera]]");
    std::vector<PlacedCamera> cameras;
    for (Section& section : sections) cameras.push_back(read_camera(section, cameras.size() + 1));
    return cameras;
}

} // namespace

Camera PlacedCamera::in_scene(const glm::dvec3& origin, float radius) const {
    Camera placed = camera;
    placed.position = glm::vec3(position - origin);
    if (!near_is_given && !placed.orthographic())
        placed.near = std::min({placed.near, 1e-3f * radius, 0.5f * placed.far});
    return placed;
}

PlacedCamera read_camera(Section& section, std::size_t number) {
    PlacedCamera read{};
    Camera& camera = read.camera;
    camera.name = section.text("name").value_or(fmt::format("camera {}", number));
    const auto position = section.place("position");
    if (!position) section.required_triple("position", -far_away, far_away);
    read.position = *position;
    const auto forward = section.aim("forward", position);
    if (!forward) section.reject("position", "a camera needs \"forward\" or \"target\"");
    camera.forward = *forward;
    camera.up = section.direction("up").value_or(glm::vec3(0, 1, 0));
    if (glm::length(glm::cross(camera.forward, camera.up)) < 1e-3f)
        section.reject("up", "the camera looks along its \"up\"; give another one");
    const auto degrees = section.number("yfov_degrees", 0.1, 179);
    const auto height = section.number("orthographic_height", 1e-9, far_away);
    if (degrees && height)
        section.reject("orthographic_height", "give \"yfov_degrees\" or \"orthographic_height\", not both");
    camera.yfov = degrees.value_or(45.0f) * (shared::PI / 180.0f);
    camera.half_height = 0.5f * height.value_or(0.0f);

    // Without a far distance there is no end.
    const auto near = section.number("near", height ? 0.0 : 1e-9, far_away);
    read.near_is_given = near.has_value();
    camera.near = near.value_or(height ? 0.0f : camera.near);
    camera.far = section.number("far", 1e-9, std::numeric_limits<double>::infinity()).value_or(camera.far);
    if (near && camera.far <= camera.near) section.reject("far", "\"far\" is not beyond \"near\"");
    section.finish();
    return read;
}

std::vector<Camera> load_camera_file(const std::filesystem::path& path, const Scene& scene) {
    const float radius = scene.bounds().radius();
    std::vector<Camera> cameras;
    for (const PlacedCamera& read : read_cameras(path))
        cameras.push_back(read.in_scene(scene.origin, radius));
    return cameras;
}

void check_camera_file(const std::filesystem::path& path) { read_cameras(path); }

std::string camera_file_text(const std::vector<Camera>& cameras, const std::string& comment,
                             const glm::dvec3& origin) {
    std::string text = "# " + ascii(comment) + "\n";
    for (const Camera& camera : cameras) {
        text += fmt::format("\n[[camera]]\nname = {}\nposition = {}\nforward = {}\nup = {}\n{}\nnear = {}\n",
                            quoted(camera.name), place(camera, origin), array(camera.forward),
                            array(camera.up), lens(camera), camera.near);
        if (std::isfinite(camera.far)) text += fmt::format("far = {}\n", camera.far);
    }
    return text;
}

} // namespace luxel
