// SPDX-License-Identifier: MIT
#include "scene/gltf/extensions.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace luxel::gltf {
namespace {

// Read, or of no consequence for a still image of the default variant.
constexpr std::array<std::string_view, 17> supported{
    "KHR_lights_punctual",     "KHR_materials_emissive_strength",
    "KHR_materials_ior",       "KHR_materials_transmission",
    "KHR_materials_specular",  "KHR_materials_volume",
    "KHR_materials_unlit",     "KHR_texture_transform",
    "KHR_mesh_quantization",   "EXT_meshopt_compression",
    "KHR_materials_variants",  "KHR_xmp_json_ld",
    "EXT_mesh_gpu_instancing", "KHR_node_visibility",
    "KHR_node_selectability",  "KHR_node_hoverability",
    "KHR_materials_clearcoat"};

// Of nodes, meshes and primitives: read, or without an image of their own.
constexpr std::array<std::string_view, 10> known_of_nodes{
    "KHR_lights_punctual",    "EXT_mesh_gpu_instancing",    "KHR_node_visibility",
    "KHR_node_selectability", "KHR_node_hoverability",      "KHR_xmp_json_ld",
    "KHR_materials_variants", "KHR_draco_mesh_compression", "EXT_structural_metadata",
    "EXT_mesh_features"};

// Read, or replaced with a warning: textures alone are no reason to refuse a scene.
constexpr std::array<std::string_view, 2> of_textures{"EXT_texture_webp", "KHR_texture_basisu"};

std::string_view advice(std::string_view extension) {
    if (extension == "KHR_draco_mesh_compression")
        return "; store the meshes uncompressed or with EXT_meshopt_compression";
    return "";
}

// "2.0", "2.1": the major number decides.
bool is_version_two(const std::string& version) { return version == "2" || version.starts_with("2."); }

} // namespace

void check_version_and_extensions(Document& document) {
    const Value root = document.root(), asset = root["asset"];
    const Value version = asset["version"], least = asset["minVersion"];
    if (!is_version_two(version.text()))
        version.fail("glTF version {} is not 2.0", printable(version.text()));
    if (least && least.text() != "2.0") least.fail("needs glTF version {}", printable(least.text()));

    const Value required = root["extensionsRequired"];
    for (std::size_t i = 0; i < required.size(); ++i) {
        const std::string& name = required.at(i).text();
        if (std::find(supported.begin(), supported.end(), name) == supported.end() &&
            std::find(of_textures.begin(), of_textures.end(), name) == of_textures.end())
            fail(Fault::unsupported, "{}: {}: the extension {} is not supported{}", document.name(),
                 required.at(i).place(), printable(name), advice(name));
    }
    if (root["animations"].size() > 0) document.warn("animations are not played, the rest pose is shown");
}

void warn_of_extensions(Document& document, const Value& value, Bearer bearer) {
    constexpr std::array names{"node", "mesh", "primitive"};
    for (const std::string& name : value["extensions"].members())
        if (std::find(known_of_nodes.begin(), known_of_nodes.end(), name) == known_of_nodes.end())
            document.warn(fmt::format("the extension {} of a {} is not supported and left out",
                                      printable(name), names[std::size_t(bearer)]));
}

} // namespace luxel::gltf
