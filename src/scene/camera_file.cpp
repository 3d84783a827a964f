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

} // namespace

Camera read_camera(Section& section, std::size_t number) {
    Camera camera;
    camera.name = section.text("name").value_or(fmt::format("camera {}", number));
    camera.position = section.required_triple("position", -far_away, far_away);
    const auto forward = section.aim("forward", camera.position);
    if (!forward) section.reject("position", "a camera needs \"forward\" or \"target\"");
    camera.forward = *forward;
    camera.up = section.direction("up").value_or(glm::vec3(0, 1, 0));
    if (glm::length(glm::cross(camera.forward, camera.up)) < 1e-3f)
        section.reject("up", "the camera looks along its \"up\"; give another one");
    camera.yfov = section.number("yfov_degrees", 0.1, 179).value_or(45.0f) * (shared::PI / 180.0f);
    camera.near = section.number("near", 1e-6, far_away).value_or(camera.near);
    camera.far = section.number("far", 1e-6, far_away).value_or(std::max(camera.far, camera.near * 1e4f));
    if (camera.far <= camera.near) section.reject("far", "\"far\" is not beyond \"near\"");
    section.finish();
    return camera;
}

std::vector<Camera> load_camera_file(const std::filesystem::path& path) {
    const toml::table table = parse_toml(path);
    Section top(table, path.string(), "");
    std::vector<Section> sections = top.sections("camera");
    top.finish();
    if (sections.empty()) top.reject("camera", "there is no [[camera]]");
    std::vector<Camera> cameras;
    for (Section& section : sections) cameras.push_back(read_camera(section, cameras.size() + 1));
    return cameras;
}

std::string camera_file_text(const std::vector<Camera>& cameras, const std::string& comment) {
    std::string text = "# " + ascii(comment) + "\n";
    for (const Camera& camera : cameras)
        text +=
            fmt::format("\n[[camera]]\nname = {}\nposition = {}\nforward = {}\nup = {}\n"
                        "yfov_degrees = {:.9g}\nnear = {}\nfar = {}\n",
                        quoted(camera.name), array(camera.position), array(camera.forward), array(camera.up),
                        double(camera.yfov) * 180.0 / double(shared::PI), camera.near, camera.far);
    return text;
}

} // namespace luxel
