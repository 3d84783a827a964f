// SPDX-License-Identifier: MIT
#include "scene/gltf/material.h"

#include <algorithm>

#include "scene/gltf/texture.h"
#include "shared/brdf.h"

namespace luxel::gltf {
namespace {

float unit(const Value& value, float fallback) {
    const float number = value.number(fallback);
    if (number < 0.0f || number > 1.0f) value.fail("{} is not within 0 to 1", number);
    return number;
}

glm::vec3 non_negative(const Value& value, glm::vec3 fallback) {
    const glm::vec3 v = value.vec<3>(fallback);
    if (glm::any(glm::lessThan(v, glm::vec3(0.0f)))) value.fail("is negative");
    return v;
}

void read_metallic_roughness(TextureTable& textures, const Value& pbr, Material& m) {
    m.base_color = pbr["baseColorFactor"].vec<4>(glm::vec4(1.0f));
    if (glm::any(glm::lessThan(m.base_color, glm::vec4(0.0f))) ||
        glm::any(glm::greaterThan(m.base_color, glm::vec4(1.0f))))
        pbr["baseColorFactor"].fail("is not within 0 to 1");
    m.base_color_texture = textures.use(pbr["baseColorTexture"], TextureRole::color);
    m.metallic = unit(pbr["metallicFactor"], 1.0f);
    m.roughness = unit(pbr["roughnessFactor"], 1.0f);
    m.metallic_roughness_texture = textures.use(pbr["metallicRoughnessTexture"], TextureRole::data);
}

void read_emission(TextureTable& textures, const Value& json, Material& m) {
    const Value strength = json["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"];
    const float scale = strength.number(1.0f);
    if (scale < 0.0f) strength.fail("is negative");
    m.emission = non_negative(json["emissiveFactor"], glm::vec3(0.0f)) * scale;
    m.emission_texture = textures.use(json["emissiveTexture"], TextureRole::color);
}

void read_alpha(const Value& json, Material& m) {
    const std::string mode = json["alphaMode"].text("OPAQUE");
    m.alpha_cutoff = json["alphaCutoff"].number(0.5f);
    if (m.alpha_cutoff < 0.0f) json["alphaCutoff"].fail("is negative");
    if (mode == "MASK")
        m.alpha_mode = AlphaMode::mask;
    else if (mode == "BLEND") {
        m.alpha_mode = AlphaMode::blend;
        m.alpha_cutoff = 0.5f;
    } else if (mode != "OPAQUE") {
        json["alphaMode"].fail("\"{}\" is not an alpha mode", printable(mode));
    }
}

// Coats have an index of refraction of 1.5.
void read_clearcoat(TextureTable& textures, const Value& extensions, Material& m) {
    const Value coat = extensions["KHR_materials_clearcoat"];
    m.clearcoat = unit(coat["clearcoatFactor"], 0.0f);
    m.clearcoat_roughness = unit(coat["clearcoatRoughnessFactor"], 0.0f);
    if (m.clearcoat <= 0.0f) return;
    m.clearcoat_texture = textures.use(coat["clearcoatTexture"], TextureRole::data);
    m.clearcoat_roughness_texture = textures.use(coat["clearcoatRoughnessTexture"], TextureRole::data);
    m.clearcoat_normal_texture = textures.use(coat["clearcoatNormalTexture"], TextureRole::normal);
    m.clearcoat_normal_scale = coat["clearcoatNormalTexture"]["scale"].number(1.0f);
}

void read_volume(const Value& volume, Material& m) {
    // A thickness of 0 is a thin wall, whatever else the volume says.
    m.thin = !(volume["thicknessFactor"].number(0.0f) > 0.0f);
    const Value color = volume["attenuationColor"], distance = volume["attenuationDistance"];
    m.attenuation_color = color.vec<3>(glm::vec3(1.0f));
    if (glm::any(glm::lessThan(m.attenuation_color, glm::vec3(0.0f))) ||
        glm::any(glm::greaterThan(m.attenuation_color, glm::vec3(1.0f))))
        color.fail("is not within 0 to 1");
    if (!distance) return;
    m.attenuation_distance = distance.number(0.0f);
    if (!(m.attenuation_distance > 0.0f)) distance.fail("{} is not above 0", m.attenuation_distance);
}

void read_dielectric(TextureTable& textures, const Value& extensions, Material& m) {
    // An index of 0 is KHR_materials_ior's way to say "reflects everything"; a very large one does the same.
    const Value ior = extensions["KHR_materials_ior"]["ior"];
    m.ior = ior.number(1.5f);
    if (m.ior != 0.0f && m.ior < 1.0f) ior.fail("{} is below 1", m.ior);
    if (m.ior == 0.0f) m.ior = 1e4f;

    const Value specular = extensions["KHR_materials_specular"];
    m.specular = unit(specular["specularFactor"], 1.0f);
    m.specular_color = non_negative(specular["specularColorFactor"], glm::vec3(1.0f));
    m.specular_texture = textures.use(specular["specularTexture"], TextureRole::data);
    m.specular_color_texture = textures.use(specular["specularColorTexture"], TextureRole::color);

    const Value transmission = extensions["KHR_materials_transmission"];
    m.transmission = unit(transmission["transmissionFactor"], 0.0f);
    m.transmission_texture = textures.use(transmission["transmissionTexture"], TextureRole::data);

    read_volume(extensions["KHR_materials_volume"], m);
    read_clearcoat(textures, extensions, m);
}

// Extensions whose absence shows, and what frames cannot draw.
void warn_of_missing_looks(Document& document, const Value& extensions, const Material& m) {
    if (m.clearcoat > 0.0f)
        document.warn(
            "frames draw a clear coat and what is below it as one lobe, without the coat's textures");
    if (m.transmission > 0.0f && m.roughness > shared::SMOOTH_ROUGHNESS &&
        m.metallic_roughness_texture.texture < 0)
        document.warn("light that passes rough glass is in the reference alone; frames leave it out");
    for (const char* name : {"KHR_materials_sheen", "KHR_materials_anisotropy", "KHR_materials_iridescence",
                             "KHR_materials_dispersion", "KHR_materials_diffuse_transmission",
                             "KHR_materials_pbrSpecularGlossiness", "KHR_materials_unlit"})
        if (extensions[name])
            document.warn(fmt::format("{} is not supported and left out of a material", name));
}

Material read_material(Document& document, TextureTable& textures, const Value& json) {
    Material m;
    m.name = printable(json["name"].text(""));
    read_metallic_roughness(textures, json["pbrMetallicRoughness"], m);
    read_emission(textures, json, m);
    read_alpha(json, m);
    read_dielectric(textures, json["extensions"], m);
    warn_of_missing_looks(document, json["extensions"], m);
    m.normal_texture = textures.use(json["normalTexture"], TextureRole::normal);
    m.normal_scale = json["normalTexture"]["scale"].number(1.0f);
    m.double_sided = json["doubleSided"].flag(false);
    return m;
}

} // namespace

void read_materials(Document& document, Scene& scene, const LoadOptions& options) {
    TextureTable textures(document);
    const Value all = document.root()["materials"];
    for (std::size_t i = 0; i < all.size(); ++i)
        scene.materials.push_back(read_material(document, textures, all.at(i)));
    scene.materials.emplace_back().name = "default";
    for (Material& m : scene.materials)
        m.backs_unseen = !m.double_sided && options.single_sided == SingleSided::cull;
    scene.textures = textures.load(options);
}

} // namespace luxel::gltf
