// SPDX-License-Identifier: MIT
// From TOML text to a merged scene. The file is untrusted: sizes are capped, and it names files beneath its
// folder.
#include "scene/scene_file.h"

#include <algorithm>
#include <cmath>

#include "core/closest.h"
#include "core/file.h"
#include "scene/camera_file.h"
#include "scene/environment.h"
#include "scene/lights.h"
#include "scene/printable.h"
#include "scene/recenter.h"
#include "scene/scene_file_objects.h"
#include "scene/scene_file_section.h"

namespace luxel {
namespace {

constexpr std::uint64_t max_map_bytes = std::uint64_t(512) << 20;
constexpr std::size_t max_geometry_files = 64;

constexpr double bright = 1e12; // W/sr, W/m2 or W/(m2 sr)
float radians(float degrees) { return degrees * (shared::PI / 180.0f); }

// The path of geometry named in a scene file: beneath its folder, or beneath that of data which the user
// named, through no symbolic link.
std::filesystem::path beneath(const std::filesystem::path& root, const std::string& data,
                              const std::string& named, const Section& section) {
    constexpr std::string_view prefix = "data:";
    const bool in_data = named.starts_with(prefix);
    if (in_data && data.empty())
        section.reject("file", fmt::format("\"{}\" needs --data DIR, or LUXEL_DATA in the environment",
                                           printable(named)));
    const std::string relative = in_data ? named.substr(prefix.size()) : named;
    const char* folder = in_data ? "data folder" : "scene file's folder";
    if (relative.empty() || relative.front() == '/' || relative.find('\0') != std::string::npos)
        section.reject("file", fmt::format("\"{}\" is no path within the {}", printable(named), folder));
    std::filesystem::path path = in_data ? std::filesystem::path(data) : root;
    for (const std::filesystem::path& component : std::filesystem::path(relative)) {
        if (component == "..")
            section.reject("file", fmt::format("\"{}\" leaves the {}", printable(named), folder));
        path /= component;
        std::error_code absent;
        if (std::filesystem::is_symlink(path, absent))
            section.reject("file", fmt::format("\"{}\" is a symbolic link; links are not followed",
                                               printable(path.string())));
    }
    return path;
}

// Turns about x, then y, then z.
glm::mat3 rotation(glm::vec3 degrees) {
    const glm::vec3 c = glm::cos(degrees * (shared::PI / 180.0f)),
                    s = glm::sin(degrees * (shared::PI / 180.0f));
    const glm::mat3 x(1, 0, 0, 0, c.x, s.x, 0, -s.x, c.x), y(c.y, 0, -s.y, 0, 1, 0, s.y, 0, c.y),
        z(c.z, s.z, 0, -s.z, c.z, 0, 0, 0, 1);
    return z * y * x;
}

// Moves everything that has a place; light intensities stay, as glTF has it for scaled nodes. The translation
// goes to the part's origin, which is in double.
void place(Scene& part, const glm::dvec3& translation, const glm::mat3& turn, glm::vec3 scale) {
    const glm::mat3 linear = turn * glm::mat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z);
    part.origin = glm::dmat3(linear) * part.origin + translation;
    for (Instance& instance : part.instances) instance.transform = glm::mat4(linear) * instance.transform;
    for (shared::Light& light : part.lights) {
        light.position = linear * light.position;
        light.direction = turn * light.direction;
        light.range *= std::cbrt(scale.x * scale.y * scale.z);
    }
    for (Camera& camera : part.cameras) {
        camera.position = linear * camera.position;
        camera.forward = glm::normalize(turn * camera.forward);
        camera.up = glm::normalize(turn * camera.up);
    }
}

template <class T> void append(std::vector<T>& all, std::vector<T>& more) {
    all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

void shift(TextureUse& use, int textures) {
    if (use.texture >= 0) use.texture += textures;
}

// Appends `part` to `scene`, renumbering what refers by index.
void merge(Scene& scene, Scene part) {
    const int textures = int(scene.textures.size()), materials = int(scene.materials.size()),
              meshes = int(scene.meshes.size());
    for (Material& m : part.materials)
        for (TextureUse* use :
             {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.emission_texture,
              &m.specular_texture, &m.specular_color_texture, &m.transmission_texture, &m.height_texture})
            shift(*use, textures);
    for (Mesh& mesh : part.meshes) mesh.material += materials;
    for (Instance& instance : part.instances) instance.mesh += meshes;
    append(scene.textures, part.textures);
    append(scene.materials, part.materials);
    append(scene.meshes, part.meshes);
    append(scene.instances, part.instances);
    append(scene.lights, part.lights);
    append(scene.cameras, part.cameras);
    append(scene.warnings, part.warnings);
}

// The geometry files, each in its place.
std::vector<Scene> load_parts(Section& top, const std::filesystem::path& root, const LoadOptions& options) {
    const auto load = [&](const Section& section, const std::string& file) {
        if (file.starts_with("builtin:")) return load_geometry(file, options);
        return load_geometry(beneath(root, options.data, file, section).string(), options);
    };

    // The short form names one file.
    std::vector<Scene> parts;
    if (!top.has("geometry")) top.reject("geometry", "\"geometry\" is missing");
    if (top.is_text("geometry")) {
        parts.push_back(load(top, *top.text("geometry")));
        return parts;
    }
    std::vector<Section> sections = top.sections("geometry");
    if (sections.size() > max_geometry_files)
        top.reject("geometry", fmt::format("more than {} geometry files", max_geometry_files));
    for (Section& section : sections) {
        const std::string file = section.required_text("file");
        const glm::dvec3 translation = section.place("translate").value_or(glm::dvec3(0.0));
        const glm::vec3 degrees = section.triple("rotate_degrees", -3600, 3600).value_or(glm::vec3(0.0f));
        const glm::vec3 scale = section.triple("scale", 1e-6, 1e6, true).value_or(glm::vec3(1.0f));
        section.finish();
        place(parts.emplace_back(load(section, file)), translation, rotation(degrees), scale);
    }
    return parts;
}

// All parts in one scene, about an origin that suits them together.
void read_geometry(Section& top, const std::filesystem::path& root, const LoadOptions& options,
                   Scene& scene) {
    std::vector<Scene> parts = load_parts(top, root, options);
    DoubleBounds bounds;
    for (const Scene& part : parts) {
        glm::dmat4 placed(1.0);
        placed[3] = glm::dvec4(part.origin, 1.0);
        bounds.add(part.bounds(), placed);
    }
    scene.origin = origin_of(bounds);
    for (Scene& part : parts) {
        move_origin(part, scene.origin);
        merge(scene, std::move(part));
    }
}

struct PlacedLight {
    shared::Light light;      // but for its position
    glm::dvec3 position{0.0}; // in the files' coordinates
};

PlacedLight read_light(Section& section) {
    PlacedLight read{};
    shared::Light& light = read.light;
    const std::string type = section.required_text("type");
    if (type == "point")
        light.type = shared::LIGHT_POINT;
    else if (type == "spot")
        light.type = shared::LIGHT_SPOT;
    else if (type == "directional")
        light.type = shared::LIGHT_DIRECTIONAL;
    else
        section.reject("type", fmt::format("unknown type \"{}\"; {}", printable(type),
                                           known_are(type, {"point", "spot", "directional"})));

    // Only what the type knows is asked for, so that anything else is reported.
    light.intensity = section.required_triple("intensity", 0, bright, true);
    const auto position = section.place("position");
    if (light.type != shared::LIGHT_DIRECTIONAL) {
        if (!position) section.reject("type", fmt::format("a {} light needs \"position\"", type));
        light.range = section.number("range", 0, far_away).value_or(0.0f);
    }
    read.position = position.value_or(glm::dvec3(0.0));
    light.direction = {0, -1, 0};
    if (light.type != shared::LIGHT_POINT) {
        const auto direction = section.aim("direction", position);
        if (!direction)
            section.reject("type", fmt::format("a {} light needs \"direction\" or \"target\"", type));
        light.direction = *direction;
    }
    if (light.type == shared::LIGHT_SPOT) {
        const float outer = section.number("outer_degrees", 0.1, 90).value_or(45.0f);
        const float inner = section.number("inner_degrees", 0, 90).value_or(0.0f);
        if (inner > outer) section.reject("inner_degrees", "\"inner_degrees\" is above \"outer_degrees\"");
        light.inner = shared::versine(radians(inner)), light.outer = shared::versine(radians(outer));
    }
    section.finish();
    return read;
}

Image read_map(Section& section, const Folder& folder, const std::string& file,
               std::vector<std::string>& warnings) {
    const auto bytes = folder.read(file, max_map_bytes);
    if (!bytes) section.reject("file", fmt::format("\"{}\" does not exist", printable(file)));
    return environment_map(decode_image(*bytes, (folder.root() / file).string(), &warnings), file, warnings);
}

Environment read_environment(Section& section, const Folder& folder, std::vector<std::string>& warnings) {
    Environment environment;
    const auto file = section.text("file");
    auto sky = section.section("sky");
    if (file.has_value() == sky.has_value()) section.reject("file", "give either \"file\" or \"sky\"");
    if (sky) {
        const glm::vec3 horizon = sky->required_triple("horizon", 0, bright, true);
        const glm::vec3 zenith = sky->required_triple("zenith", 0, bright, true);
        const glm::vec3 ground = sky->triple("ground", 0, bright, true).value_or(glm::vec3(0.0f));
        sky->finish();
        environment = gradient_sky(horizon, zenith, ground);
    }
    environment.rotation = radians(section.number("rotation_degrees", -3600, 3600).value_or(0.0f));
    environment.scale = section.number("scale", 0, bright).value_or(1.0f);
    section.finish();
    if (file) environment.radiance = read_map(section, folder, *file, warnings);
    return environment;
}

} // namespace

Scene load_scene_file(const std::filesystem::path& path, const LoadOptions& options) {
    const toml::table table = parse_toml(path);
    const Folder folder(path.has_parent_path() ? path.parent_path() : ".");
    Section top(table, path.string(), "");

    // Small things first: a slip in a light should not cost the loading of the geometry.
    Scene scene;
    std::vector<PlacedLight> lights;
    std::vector<PlacedCamera> cameras;
    scene.name = top.text("name").value_or(path.stem().string());
    const bool replace_lights = top.flag("replace_lights").value_or(false);
    const bool replace_cameras = top.flag("replace_cameras").value_or(false);
    for (Section& section : top.sections("light")) lights.push_back(read_light(section));
    for (Section& section : top.sections("camera"))
        cameras.push_back(read_camera(section, cameras.size() + 1));
    std::vector<ObjectRule> rules;
    for (Section& section : top.sections("object")) rules.push_back(read_object_rule(section));
    auto environment = top.section("environment");
    if (environment) scene.environment = read_environment(*environment, folder, scene.warnings);

    read_geometry(top, folder.root(), options, scene);
    top.finish();
    apply_object_rules(scene, rules, folder);

    // The file's own cameras come before those of its geometry: they were chosen for it.
    if (replace_lights) scene.lights.clear();
    if (replace_cameras) scene.cameras.clear();
    for (PlacedLight& read : lights) {
        read.light.position = glm::vec3(read.position - scene.origin);
        scene.lights.push_back(read.light);
    }
    const float radius = scene.bounds().radius();
    std::vector<Camera> own;
    for (const PlacedCamera& read : cameras) own.push_back(read.in_scene(scene.origin, radius));
    own.insert(own.end(), scene.cameras.begin(), scene.cameras.end());
    scene.cameras = std::move(own);
    return scene;
}

} // namespace luxel
