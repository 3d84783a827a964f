// SPDX-License-Identifier: MIT
// A material change must not reach instances outside the rule, so shared meshes and materials are split
// first.
#include "scene/scene_file_objects.h"

#include <map>

#include "core/image_io.h"
#include "scene/load_texture.h"
#include "scene/printable.h"
#include "scene/scene_file.h"

namespace luxel {
namespace {

constexpr std::uint64_t max_copied_vertices = std::uint64_t(32) << 20;
constexpr std::size_t names_in_sentence = 8;

// An overridden quantity no longer reads its texture.
void change(Material& material, const ObjectRule& rule) {
    if (rule.base_color) {
        material.base_color = glm::vec4(*rule.base_color, material.base_color.a);
        if (material.alpha_mode == AlphaMode::opaque) material.base_color_texture = {};
    }
    if (rule.metallic || rule.roughness) {
        const bool textured = material.metallic_roughness_texture.texture >= 0;
        if (textured && !(rule.metallic && rule.roughness))
            rule.section.reject("name",
                                fmt::format("material \"{}\" has one texture for both, so give \"metallic\" "
                                            "and \"roughness\" together",
                                            printable(material.name)));
        material.metallic = rule.metallic.value_or(material.metallic);
        material.roughness = rule.roughness.value_or(material.roughness);
        material.metallic_roughness_texture = {};
    }
    if (rule.emission) material.emission = *rule.emission, material.emission_texture = {};
    if (rule.transmission) material.transmission = *rule.transmission, material.transmission_texture = {};
    if (rule.ior) material.ior = *rule.ior;
    if (rule.thin) material.thin = *rule.thin;
    if (rule.attenuation_color) material.attenuation_color = *rule.attenuation_color;
    if (rule.attenuation_distance) material.attenuation_distance = *rule.attenuation_distance;
    if (rule.clearcoat) {
        material.clearcoat = *rule.clearcoat;
        material.clearcoat_texture = material.clearcoat_normal_texture = {};
    }
    if (rule.clearcoat_roughness)
        material.clearcoat_roughness = *rule.clearcoat_roughness, material.clearcoat_roughness_texture = {};
}

// Adds the rules' height maps to the scene's textures, each file once.
std::map<std::string, int> load_height_maps(Scene& scene, const std::vector<ObjectRule>& rules,
                                            const Folder& folder) {
    std::map<std::string, int> index_of;
    std::uint64_t taken = 0;
    for (const ObjectRule& rule : rules) {
        if (!rule.height_map || index_of.contains(*rule.height_map)) continue;
        const std::string& file = *rule.height_map;
        const auto bytes = folder.read(file, max_image_file_bytes);
        if (!bytes) rule.section.reject("height_map", fmt::format("\"{}\" does not exist", printable(file)));
        Texture texture;
        texture.name = file;
        texture.pixels = decode_pixels(*bytes, (folder.root() / file).string());
        if ((taken += texture.pixels.bytes()) > max_texture_bytes)
            fail(Fault::resource, "{}: its height maps need more than {} GiB", scene.name,
                 max_texture_bytes >> 30);
        index_of[file] = int(scene.textures.size());
        scene.textures.push_back(std::move(texture));
    }
    return index_of;
}

void set_height_map(Material& material, const ObjectRule& rule, int texture) {
    material.height_texture = {.texture = texture};
    material.height_scale = *rule.height_scale;
}

std::vector<int> uses_of_meshes(const Scene& scene, const std::vector<bool>* chosen) {
    std::vector<int> uses(scene.meshes.size());
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (!chosen || (*chosen)[i]) ++uses[std::size_t(scene.instances[i].mesh)];
    return uses;
}

// Gives the chosen instances meshes and materials of their own, and changes those.
void change_chosen(Scene& scene, const ObjectRule& rule, const std::vector<bool>& chosen,
                   const std::map<std::string, int>& height_maps, std::uint64_t& copied_vertices) {
    const std::vector<int> all = uses_of_meshes(scene, nullptr), inside = uses_of_meshes(scene, &chosen);
    std::map<int, int> own_material;
    for (std::size_t m = 0; m < all.size(); ++m) {
        if (inside[m] == 0) continue;
        if (rule.height_map && scene.meshes[m].texcoords[0].empty())
            rule.section.reject("height_map", fmt::format("mesh \"{}\" has no texture coordinates",
                                                          printable(scene.meshes[m].name)));
        const int old = scene.meshes[m].material;
        const auto [place, is_new] = own_material.try_emplace(old, int(scene.materials.size()));
        if (is_new) {
            Material material = scene.materials[std::size_t(old)];
            change(material, rule);
            if (rule.height_map) set_height_map(material, rule, height_maps.at(*rule.height_map));
            scene.materials.push_back(std::move(material));
        }

        // A mesh that others draw too is copied; how much may be is bounded, as the file is not trusted.
        std::size_t target = m;
        if (inside[m] < all[m]) {
            copied_vertices += scene.meshes[m].positions.size();
            if (copied_vertices > max_copied_vertices)
                rule.section.reject("name", "too many meshes would have to be copied for this change");
            target = scene.meshes.size();
            Mesh copy = scene.meshes[m];
            scene.meshes.push_back(std::move(copy));
            for (std::size_t i = 0; i < chosen.size(); ++i)
                if (chosen[i] && scene.instances[i].mesh == int(m)) scene.instances[i].mesh = int(target);
        }
        scene.meshes[target].material = place->second;
    }
}

[[noreturn]] void reject_pattern(const Scene& scene, const ObjectRule& rule) {
    std::string names;
    for (std::size_t i = 0; i < scene.instances.size() && i < names_in_sentence; ++i)
        names += (i ? ", " : "") + printable(scene.instances[i].name);
    const bool more = scene.instances.size() > names_in_sentence;
    rule.section.reject("name", fmt::format("no object is named \"{}\"; there are {}{}",
                                            printable(rule.pattern), names, more ? ", ..." : ""));
}

// The keys "impostor", "impostor_size", "impostor_error" and "impostor_distance".
std::optional<Impostor> read_impostor(Section& section) {
    constexpr const char* size_key = "impostor_size";
    constexpr const char* error_key = "impostor_error";
    constexpr const char* distance_key = "impostor_distance";
    const auto kind = section.text("impostor");
    const auto size = section.integer(size_key, 8, 4096);
    const auto error = section.number(error_key, 0.01, 1e4);
    const auto distance = section.number(distance_key, 1e-6, 1e6);
    Impostor impostor;
    if (kind == "billboard")
        impostor.kind = ImpostorKind::billboard;
    else if (kind == "nailboard")
        impostor.kind = ImpostorKind::nailboard;
    else if (kind == "billboard_cloud")
        impostor.kind = ImpostorKind::billboard_cloud;
    else if (kind && kind != "none")
        section.reject(
            "impostor",
            fmt::format("\"{}\" is none of billboard, nailboard, billboard_cloud, none", printable(*kind)));

    // Each kind has its own measure of error.
    const bool any = impostor.kind != ImpostorKind::none;
    const bool cloud = impostor.kind == ImpostorKind::billboard_cloud;
    if (size && !any) section.reject(size_key, "impostor_size is of an impostor; give \"impostor\", too");
    if (error && (cloud || !any))
        section.reject(error_key, "impostor_error is of a billboard or a nailboard");
    if (distance && !cloud) section.reject(distance_key, "impostor_distance is of a billboard_cloud");
    if (cloud && !distance) section.reject("impostor", "a billboard_cloud needs \"impostor_distance\"");
    impostor.size = size.value_or(impostor.size);
    impostor.error = error.value_or(impostor.error);
    impostor.distance = distance.value_or(impostor.distance);
    return kind ? std::optional(impostor) : std::nullopt;
}

} // namespace

bool matches_glob(std::string_view pattern, std::string_view name) {
    // On a mismatch only the latest * needs to take one character more: no backtracking beyond it.
    constexpr std::size_t none = std::string_view::npos;
    std::size_t p = 0, n = 0, star = none, resume = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*')
            star = p++, resume = n;
        else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n]))
            ++p, ++n;
        else if (star != none)
            p = star + 1, n = ++resume;
        else
            return false;
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

ObjectRule read_object_rule(Section& section) {
    ObjectRule rule{.section = section, .pattern = section.required_text("name")};
    rule.role = section.text("role");
    rule.base_color = section.triple("base_color", 0, 1, true);
    rule.metallic = section.number("metallic", 0, 1);
    rule.roughness = section.number("roughness", 0, 1);
    rule.emission = section.triple("emission", 0, 1e12, true);
    rule.transmission = section.number("transmission", 0, 1);
    rule.ior = section.number("ior", 1, 10);
    rule.thin = section.flag("thin");
    rule.attenuation_color = section.triple("attenuation_color", 0, 1, true);
    rule.attenuation_distance = section.number("attenuation_distance", 1e-6, 1e6);
    rule.clearcoat = section.number("clearcoat", 0, 1);
    rule.clearcoat_roughness = section.number("clearcoat_roughness", 0, 1);
    rule.height_map = section.text("height_map");
    rule.height_scale = section.number("height_scale", 1e-6, 1e3);
    rule.impostor = read_impostor(section);
    section.finish();
    if (rule.height_map.has_value() != rule.height_scale.has_value())
        section.reject(rule.height_map ? "height_map" : "height_scale",
                       "give \"height_map\" and \"height_scale\" together");
    if (rule.attenuation_color.has_value() != rule.attenuation_distance.has_value())
        section.reject(rule.attenuation_color ? "attenuation_color" : "attenuation_distance",
                       "give \"attenuation_color\" and \"attenuation_distance\" together");
    if (rule.attenuation_color && rule.thin.value_or(false))
        section.reject("thin", "a thin sheet has no inside that absorbs; give thin = false");
    if (!rule.role && !rule.impostor && !rule.changes_material())
        section.reject("name", "the object changes nothing");
    return rule;
}

void apply_object_rules(Scene& scene, const std::vector<ObjectRule>& rules, const Folder& folder) {
    const std::map<std::string, int> height_maps = load_height_maps(scene, rules, folder);
    std::uint64_t copied_vertices = 0;
    for (const ObjectRule& rule : rules) {
        std::vector<bool> chosen(scene.instances.size());
        bool any = false;
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            chosen[i] = matches_glob(rule.pattern, scene.instances[i].name);
            any = any || chosen[i];
            if (chosen[i] && rule.role) scene.instances[i].role = *rule.role;
            if (chosen[i] && rule.impostor) scene.instances[i].impostor = *rule.impostor;
        }
        if (!any) reject_pattern(scene, rule);
        if (rule.changes_material()) change_chosen(scene, rule, chosen, height_maps, copied_vertices);
    }
}

} // namespace luxel
