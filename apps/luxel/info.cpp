// SPDX-License-Identifier: MIT
// luxel info: what is in a scene.
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

Json describe(const Scene& scene, const std::string& source) {
    const Bounds bounds = scene.bounds();
    std::size_t texels = 0;
    for (const Texture& t : scene.textures)
        texels += std::size_t(t.pixels.width) * std::size_t(t.pixels.height);
    Json json = {{"scene", source},
                 {"triangles", scene.triangles()},
                 {"meshes", scene.meshes.size()},
                 {"instances", scene.instances.size()},
                 {"materials", scene.materials.size()},
                 {"textures", scene.textures.size()},
                 {"texels", texels},
                 {"emissive_triangles", emissive_triangles(scene).size()},
                 {"environment", !scene.environment.empty()},
                 {"bounds", {{"least", vector_json(bounds.least)}, {"most", vector_json(bounds.most)}}},
                 {"lights", Json::array()},
                 {"cameras", Json::array()},
                 {"impostors", Json::array()},
                 {"warnings", scene.warnings}};
    for (const shared::Light& light : scene.lights)
        json["lights"].push_back({{"type", light_type(light)},
                                  {"position", vector_json(light.position)},
                                  {"direction", vector_json(light.direction)},
                                  {"intensity", vector_json(light.intensity)}});
    for (const Camera& camera : scene.cameras)
        json["cameras"].push_back({{"name", camera.name},
                                   {"position", vector_json(camera.position)},
                                   {"forward", vector_json(camera.forward)},
                                   {"yfov", camera.yfov}});
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

void print(const Scene& scene, const Json& json) {
    for (const char* key :
         {"triangles", "meshes", "instances", "materials", "textures", "emissive_triangles"})
        fmt::print("{:<20}{}\n", key, json[key].get<std::size_t>());
    fmt::print("{:<20}{}\n", "environment", scene.environment.empty() ? "no" : "yes");
    const Bounds bounds = scene.bounds();
    fmt::print("{:<20}{} to {} m\n", "bounds", text_of(bounds.least), text_of(bounds.most));
    for (const shared::Light& light : scene.lights)
        fmt::print("{:<20}{} at {} toward {}, intensity {}\n", "light", light_type(light),
                   text_of(light.position), text_of(light.direction), text_of(light.intensity));
    for (const Camera& camera : scene.cameras)
        fmt::print("{:<20}'{}' at {} toward {}, {:.1f} degrees high\n", "camera", camera.name,
                   text_of(camera.position), text_of(camera.forward), glm::degrees(camera.yfov));
    for (const ImpostorObject& object : impostor_objects(scene)) {
        const Impostor& i = object.impostor;
        const bool cloud = i.kind == ImpostorKind::billboard_cloud;
        fmt::print("{:<20}{} for '{}', {} texels, error {} {}\n", "impostor", impostor_kind(i.kind),
                   object.name, i.size, cloud ? i.distance : i.error, cloud ? "m" : "pixels");
    }
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
    std::string names;
    for (const BuiltinScene& scene : builtin_scenes())
        names += fmt::format("\n  builtin:{:<18}{}", scene.name, scene.meaning);
    command->add_option("scene", *source, "builtin:NAME, .gltf, .glb, .obj or .toml")->required();
    command->footer("Built-in scenes:" + names + "\nExample: luxel info builtin:cornell --json");
    command->callback([source, &global] { run(*source, global); });
}

} // namespace luxel::app
