// SPDX-License-Identifier: MIT
#include "scene/export/gltf/gltf.h"

#include <algorithm>
#include <cmath>

#include "core/file.h"
#include "core/image_io.h"
#include "scene/export/gltf/parts.h"

namespace luxel {
namespace gltf_export {
namespace {

Json matrix_json(const glm::mat4& m) {
    Json json = Json::array();
    for (int i = 0; i < 16; ++i) json.push_back(m[i / 4][i % 4]);
    return json;
}

// A node that looks along `forward`, its -z.
Json looking_node(glm::vec3 position, glm::vec3 forward, glm::vec3 up) {
    const glm::vec3 right = glm::normalize(glm::cross(forward, up));
    glm::mat4 m(1.0f);
    m[0] = glm::vec4(right, 0.0f), m[1] = glm::vec4(glm::cross(right, forward), 0.0f);
    m[2] = glm::vec4(-forward, 0.0f), m[3] = glm::vec4(position, 1.0f);
    return {{"matrix", matrix_json(m)}};
}

void add_node(Export& out, Json node) {
    out.json["scenes"][0]["nodes"].push_back(out.json["nodes"].size());
    out.json["nodes"].push_back(std::move(node));
}

void add_light(Export& out, const shared::Light& light) {
    if (light.type != shared::LIGHT_POINT && light.type != shared::LIGHT_SPOT &&
        light.type != shared::LIGHT_DIRECTIONAL)
        return out.note("lights of a kind of their own: left out");
    const float intensity = power_of_two_over(light.intensity);
    Json json = {{"color", to_json(light.intensity / intensity)}, {"intensity", intensity}};
    json["type"] = light.type == shared::LIGHT_POINT  ? "point"
                   : light.type == shared::LIGHT_SPOT ? "spot"
                                                      : "directional";
    if (light.range > 0.0f) json["range"] = light.range;
    if (light.type == shared::LIGHT_SPOT)
        json["spot"] = {{"innerConeAngle", shared::versine_angle(light.inner)},
                        {"outerConeAngle", shared::versine_angle(light.outer)}};
    Json& lights = out.json["extensions"]["KHR_lights_punctual"]["lights"];
    // Any direction that is not the light's own.
    const glm::vec3 up = std::abs(light.direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    Json node = light.type == shared::LIGHT_POINT && light.direction == glm::vec3(0.0f)
                    ? looking_node(light.position, {0, 0, -1}, {0, 1, 0})
                    : looking_node(light.position, light.direction, up);
    node["extensions"]["KHR_lights_punctual"]["light"] = lights.size();
    lights.push_back(std::move(json));
    out.extensions.insert("KHR_lights_punctual");
    add_node(out, std::move(node));
}

void add_camera(Export& out, const Camera& camera, const ExportedView& view) {
    const float aspect = float(view.width) / float(view.height);
    Json json = {{"type", camera.half_height > 0.0f ? "orthographic" : "perspective"}};
    if (camera.half_height > 0.0f) {
        // A parallel view must end somewhere: behind all that there is.
        const Bounds bounds = out.scene.bounds();
        const float behind = glm::length(camera.position - bounds.center()) + 2.0f * bounds.radius() + 1.0f;
        json["orthographic"] = {{"xmag", camera.half_height * aspect},
                                {"ymag", camera.half_height},
                                {"znear", camera.near},
                                {"zfar", std::isfinite(camera.far) ? camera.far : behind}};
    } else {
        json["perspective"] = {{"aspectRatio", aspect}, {"yfov", camera.yfov}, {"znear", camera.near}};
        if (std::isfinite(camera.far)) json["perspective"]["zfar"] = camera.far;
    }
    Json node = looking_node(camera.position, camera.forward, camera.up);
    if (!camera.name.empty()) node["name"] = camera.name;
    node["camera"] = out.json["cameras"].size();
    out.json["cameras"].push_back(std::move(json));
    add_node(out, std::move(node));
}

bool same(const Camera& a, const Camera& b) { return a.position == b.position && a.forward == b.forward; }

void add_environment(Export& out) {
    const Environment& e = out.scene.environment;
    if (e.empty()) return;
    const std::string name = out.stem + "-sky.exr";
    write_exr(out.folder / name, {{"", e.radiance}});
    out.note(fmt::format("the environment: in {}, for --environment with --environment-scale {:.7g}", name,
                         e.scale));
    if (e.rotation != 0.0f)
        out.note(fmt::format("the environment's rotation of {:.7g} degrees", glm::degrees(e.rotation)));
}

// A binary file: header, JSON padded by spaces, the buffer.
std::string glb(std::string json, const std::string& bytes) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string file;
    const auto word = [&](std::size_t value) {
        const std::uint32_t w = std::uint32_t(value);
        for (int i = 0; i < 4; ++i) file += char(w >> 8 * i & 255u);
    };
    file += "glTF";
    word(2), word(12 + 8 + json.size() + (bytes.empty() ? 0 : 8 + bytes.size()));
    word(json.size()), file += "JSON", file += json;
    if (!bytes.empty()) word(bytes.size()), file += std::string("BIN\0", 4), file += bytes;
    return file;
}

} // namespace

Json to_json(glm::vec3 v) { return {v.x, v.y, v.z}; }

void add_meshes(Export& out) {
    for (const Mesh& mesh : out.scene.meshes) {
        Json attributes = {{"POSITION", out.buffer.add(mesh.positions, true)}};
        if (!mesh.normals.empty()) attributes["NORMAL"] = out.buffer.add(mesh.normals);
        if (!mesh.tangents.empty()) attributes["TANGENT"] = out.buffer.add(mesh.tangents);
        for (int set = 0; set < 2; ++set)
            if (!mesh.texcoords[set].empty())
                attributes[fmt::format("TEXCOORD_{}", set)] = out.buffer.add(mesh.texcoords[set]);
        if (!mesh.colors.empty()) attributes["COLOR_0"] = out.buffer.add(mesh.colors);
        Json primitive = {{"attributes", std::move(attributes)}, {"indices", out.buffer.add(mesh.indices)}};
        if (std::size_t(mesh.material) < out.json["materials"].size()) primitive["material"] = mesh.material;
        Json json = {{"primitives", {std::move(primitive)}}};
        if (!mesh.name.empty()) json["name"] = mesh.name;
        out.json["meshes"].push_back(std::move(json));
    }
}

void add_nodes(Export& out, const ExportedView& view) {
    for (const Instance& instance : out.scene.instances) {
        Json node = {{"mesh", instance.mesh}};
        if (!instance.name.empty()) node["name"] = instance.name;
        if (instance.transform != glm::mat4(1.0f)) node["matrix"] = matrix_json(instance.transform);
        if (instance.impostor.kind != ImpostorKind::none) out.note("impostors: what they stand for");
        if (!instance.role.empty()) out.note("roles of objects: left out");
        add_node(out, std::move(node));
    }
    for (const shared::Light& light : out.scene.lights) add_light(out, light);
    const std::vector<Camera>& cameras = out.scene.cameras;
    const bool own =
        std::any_of(cameras.begin(), cameras.end(), [&](const Camera& c) { return same(c, view.camera); });
    if (!own) add_camera(out, view.camera, view);
    for (const Camera& camera : cameras) add_camera(out, camera, view);

    // Far scenes are about an origin of their own: one node above all moves them back.
    const glm::dvec3 origin = out.scene.origin;
    if (origin == glm::dvec3(0.0)) return;
    Json& roots = out.json["scenes"][0]["nodes"];
    Json root = {{"name", "origin"}, {"translation", {origin.x, origin.y, origin.z}}, {"children", roots}};
    roots = {out.json["nodes"].size()};
    out.json["nodes"].push_back(std::move(root));
}

} // namespace gltf_export

std::vector<std::string> write_gltf(const std::filesystem::path& file, const Scene& scene,
                                    const ExportedView& view) {
    using gltf_export::Json;
    const bool binary = file.extension() == ".glb";
    gltf_export::Export out(scene, file);
    Json& json = out.json;
    json = {{"asset", {{"version", "2.0"}, {"generator", "luxel"}}},
            {"extensionsUsed", Json::array()},
            {"scene", 0},
            {"scenes", {{{"name", scene.name}, {"nodes", Json::array()}}}}};
    gltf_export::add_textures(out);
    gltf_export::add_materials(out);
    gltf_export::add_meshes(out);
    gltf_export::add_nodes(out, view);
    gltf_export::add_environment(out);

    json["accessors"] = out.buffer.accessors;
    json["bufferViews"] = out.buffer.views;
    json["buffers"] = {{{"byteLength", out.buffer.bytes.size()}}};
    for (const std::string& name : out.extensions) json["extensionsUsed"].push_back(name);
    if (out.extensions.empty()) json.erase("extensionsUsed");
    std::vector<std::string> lost = out.approximated();
    if (!lost.empty()) json["asset"]["extras"]["approximated"] = lost;
    if (binary) {
        write_file(file, std::string_view(gltf_export::glb(json.dump(), out.buffer.bytes)));
    } else {
        json["buffers"][0]["uri"] = out.stem + ".bin";
        write_file(out.folder / (out.stem + ".bin"), std::string_view(out.buffer.bytes));
        write_file(file, std::string_view(json.dump(1) + "\n"));
    }
    return lost;
}

} // namespace luxel
