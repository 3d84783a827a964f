// SPDX-License-Identifier: MIT
#include "experiments/view_choice.h"

#include <cctype>
#include <set>

#include <fmt/format.h>

#include "core/closest.h"
#include "core/error.h"
#include "scene/camera_file.h"
#include "scene/views.h"

namespace luxel {

namespace {

const Camera* find_view(const std::vector<Camera>& cameras, const std::string& wanted) {
    for (const Camera& camera : cameras)
        if (camera.name == wanted) return &camera;
    const bool number =
        !wanted.empty() && wanted.size() < 7 && wanted.find_first_not_of("0123456789") == wanted.npos;
    if (number && std::stoul(wanted) < cameras.size()) return &cameras[std::stoul(wanted)];
    return nullptr;
}

// rays: null to have them built where views are drawn.
std::vector<Camera> all_views(const Scene& scene, const RayCaster* rays, const ViewChoice& choice) {
    if (!choice.file.empty() && choice.drawn > 0)
        fail(Fault::usage, "{}: cameras: give a camera script or a number of drawn views, not both",
             choice.file);
    if (!choice.file.empty()) return load_camera_file(choice.file, scene);
    if (choice.drawn == 0) return scene.cameras;
    if (rays) return draw_views(scene, *rays, choice.drawn, choice.seed);
    return draw_views(scene, RayCaster(scene), choice.drawn, choice.seed);
}

std::vector<Camera> chosen_of(std::vector<Camera> all, const ViewChoice& choice) {
    make_names_unique(all);
    if (choice.names.empty()) return all;

    std::vector<Camera> chosen;
    for (const std::string& name : choice.names) {
        const Camera* camera = find_view(all, name);
        if (!camera) {
            std::vector<std::string> known;
            for (const Camera& c : all) known.push_back(c.name);
            fail(Fault::usage, "--view {}: no such view; {}", name, known_are(name, known));
        }
        chosen.push_back(*camera);
    }
    return chosen;
}

} // namespace

std::string file_name_of(const std::string& name) {
    std::string out;
    for (char c : name)
        out += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == '.' ? c : '_';
    if (out.empty() || out[0] == '.') out.insert(out.begin(), '_');
    return out.substr(0, 100);
}

// Names become file names, so they must differ as such.
void make_names_unique(std::vector<Camera>& cameras) {
    std::set<std::string> taken;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        std::string name = cameras[i].name.empty() ? fmt::format("view{}", i) : cameras[i].name;
        const std::string stem = name;
        for (int n = 2; !taken.insert(file_name_of(name)).second; ++n) name = fmt::format("{}-{}", stem, n);
        cameras[i].name = name;
    }
}

std::vector<Camera> choose_views(const RayCaster& rays, const ViewChoice& choice) {
    return chosen_of(all_views(rays.scene(), &rays, choice), choice);
}

std::vector<Camera> choose_views(const Scene& scene, const ViewChoice& choice) {
    return chosen_of(all_views(scene, nullptr, choice), choice);
}

} // namespace luxel
