// SPDX-License-Identifier: MIT
// luxel info: what is in a scene.
#include <cmath>
#include <cstdio>

#include "options.h"
#include "scene/lights.h"
#include "scene/load.h"
#include "scene/roles.h"

namespace luxel::app {

namespace {

using Json = nlohmann::ordered_json;

const char* light_type(const shared::Light& light) {
    switch (light.type) {
    case shared::LIGHT_POINT:
        return "point";
    case shared::LIGHT_SPOT:
        return "spot";
    case shared::LIGHT_DIRECTIONAL:
        return "directional";
    default:
        return "cosine";
    }
}

const char* impostor_kind(ImpostorKind kind) {
    switch (kind) {
    case ImpostorKind::billboard:
        return "billboard";
    case ImpostorKind::nailboard:
        return "nailboard";
    case ImpostorKind::billboard_cloud:
        return "billboard_cloud";
    default:
        return "none";
    }
}

Json vector_json(glm::vec3 v) { return {v.x, v.y, v.z}; }

// A position in the files' coordinates.
Json place_json(const Scene& scene, glm::vec3 p) {
    if (scene.origin == glm::dvec3(0.0)) return vector_json(p);
    const glm::dvec3 at = scene.origin + glm::dvec3(p);
    return {at.x, at.y, at.z};
}

// Infinite distances are null.
Json distance_json(float v) { return std::isfinite(v) ? Json(v) : Json(nullptr); }

Json describe(const Scene& scene, const std::string& source) {
    const Bounds bounds = scene.bounds();
    std::size_t texels = 0;
    for (const Texture& t : scene.textures)
        texels += std::size_t(t.pixels.width) * std::size_t(t.pixels.height);
    Json json = {
        {"scene", source},
        {"triangles", scene.triangles()},
        {"meshes", scene.meshes.size()},
        {"instances", scene.instances.size()},
        {"materials", scene.materials.size()},
        {"textures", scene.textures.size()},
        {"texels", texels},
        {"emissive_triangles", emissive_triangles(scene).size()},
        {"environment", !scene.environment.empty()},
        {"bounds", {{"least", place_json(scene, bounds.least)}, {"most", place_json(scene, bounds.most)}}},
        {"origin", {scene.origin.x, scene.origin.y, scene.origin.z}},
        {"lights", Json::array()},
        {"cameras", Json::array()},
        {"impostors", Json::array()},
        {"warnings", scene.warnings}};
    for (const shared::Light& light : scene.lights)
        json["lights"].push_back({{"type", light_type(light)},
                                  {"position", place_json(scene, light.position)},
                                  {"direction", vector_json(light.direction)},
                                  {"intensity", vector_json(light.intensity)}});
    for (const Camera& camera : scene.cameras)
        json["cameras"].push_back(
            {{"name", camera.name},
             {"position", place_json(scene, camera.position)},
             {"forward", vector_json(camera.forward)},
             {"up", vector_json(camera.up)},
             {"yfov", camera.orthographic() ? Json(nullptr) : Json(camera.yfov)},
             {"height", camera.orthographic() ? Json(2.0f * camera.half_height) : Json(nullptr)},
             {"near", camera.near},
             {"far", distance_json(camera.far)}});
    for (const ImpostorObject& object : impostor_objects(scene)) {
        const Impostor& i = object.impostor;
        Json entry = {{"name", object.name}, {"kind", impostor_kind(i.kind)}, {"size", i.size}};
        const bool cloud = i.kind == ImpostorKind::billboard_cloud;
        entry[cloud ? "distance" : "error"] = cloud ? i.distance : i.error;
        entry["instances"] = object.instances.size();
        json["impostors"].push_back(std::move(entry));
    }
    return json;
}

std::string text_of(glm::vec3 v) { return fmt::format("({:.3g}, {:.3g}, {:.3g})", v.x, v.y, v.z); }

// Positions by the files' coordinates, to the millimeter where they are large.
std::string place_text(const Scene& scene, glm::vec3 p) {
    if (scene.origin == glm::dvec3(0.0)) return text_of(p);
    const glm::dvec3 at = scene.origin + glm::dvec3(p);
    return fmt::format("({:.3f}, {:.3f}, {:.3f})", at.x, at.y, at.z);
}

std::string lens_text(const Camera& camera) {
    const std::string reach = std::isfinite(camera.far) ? fmt::format(" to {:.4g} m", camera.far) : "";
    return (camera.orthographic() ? fmt::format("orthographic, {:.4g} m high", 2.0f * camera.half_height)
                                  : fmt::format("{:.1f} degrees high", glm::degrees(camera.yfov))) +
           reach;
}

void print(const Scene& scene, const Json& json) {
    std::vector<std::vector<std::string>> lines;
    for (const char* key :
         {"triangles", "meshes", "instances", "materials", "textures", "emissive_triangles"})
        lines.push_back({key, fmt::format("{}", json[key].get<std::size_t>())});
    lines.push_back({"environment", scene.environment.empty() ? "no" : "yes"});
    const Bounds bounds = scene.bounds();
    lines.push_back({"bounds", fmt::format("{} to {} m", place_text(scene, bounds.least),
                                           place_text(scene, bounds.most))});
    if (scene.origin != glm::dvec3(0.0))
        lines.push_back(
            {"origin", fmt::format("computed about ({:.10g}, {:.10g}, {:.10g}), which is subtracted "
                                   "from all positions",
                                   scene.origin.x, scene.origin.y, scene.origin.z)});
    for (const shared::Light& light : scene.lights)
        lines.push_back({"light", light_type(light), "at " + place_text(scene, light.position),
                         "toward " + text_of(light.direction), "intensity " + text_of(light.intensity)});
    for (const Camera& camera : scene.cameras)
        lines.push_back({"camera", "'" + camera.name + "'", "at " + place_text(scene, camera.position),
                         "toward " + text_of(camera.forward), lens_text(camera)});
    for (const ImpostorObject& object : impostor_objects(scene)) {
        const Impostor& i = object.impostor;
        const bool cloud = i.kind == ImpostorKind::billboard_cloud;
        lines.push_back({"impostor", impostor_kind(i.kind), "'" + object.name + "'",
                         fmt::format("{} texels", i.size),
                         fmt::format("error {} {}", cloud ? i.distance : i.error, cloud ? "m" : "pixels")});
    }
    fmt::print("{}", in_columns(lines));
}

void run(const std::string& source, const Global& global) {
    const Scene scene = load(source, global);
    const Json json = describe(scene, source);
    if (global.json)
        print_json(json);
    else
        print(scene, json);
}

} // namespace

void add_info(CLI::App& app, const Global& global) {
    auto source = std::make_shared<std::string>();
    CLI::App* command =
        app.add_subcommand("info", "Say what is in a scene: triangles, materials, lights, cameras");
    command->add_option("scene", *source, "builtin:NAME, .gltf, .glb, .obj or .toml")->required();
    command->footer("Example: luxel info builtin:cornell --json; luxel scenes lists the built-in ones");
    command->callback([source, &global] { run(*source, global); });
}

} // namespace luxel::app
