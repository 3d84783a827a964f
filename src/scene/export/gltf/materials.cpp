// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "scene/export/gltf/parts.h"

namespace luxel::gltf_export {
namespace {

int wrap_code(Wrap wrap) { return wrap == Wrap::clamp ? 33071 : wrap == Wrap::mirror ? 33648 : 10497; }

std::vector<std::uint8_t> png_of(const Pixels& pixels) {
    const std::size_t texels = std::size_t(pixels.width) * std::size_t(pixels.height);
    bool opaque = true;
    for (std::size_t i = 0; i < texels; ++i)
        opaque = opaque && pixels.value(4 * i + 3) > 0.99999f; // to rounding
    Image image(pixels.width, pixels.height, opaque ? 3 : 4);
    for (std::size_t i = 0; i < texels; ++i)
        for (std::size_t c = 0; c < std::size_t(image.channels); ++c)
            image.data[i * std::size_t(image.channels) + c] = pixels.value(4 * i + c);
    return encode_png(image);
}

// What KHR_texture_transform says: columns (c sx, -s sx), (s sy, c sy), offset.
Json transform_json(const glm::mat3& m) {
    const float sx = std::hypot(m[0].x, m[0].y),
                sy = std::hypot(m[1].x, m[1].y) * (glm::determinant(m) < 0.0f ? -1.0f : 1.0f);
    Json json = {{"offset", {m[2].x, m[2].y}}, {"scale", {sx, sy}}};
    if (m[0].y != 0.0f) json["rotation"] = std::atan2(-m[0].y, m[0].x);
    return json;
}

Json use_json(Export& out, const TextureUse& use) {
    Json json = {{"index", use.texture}};
    if (use.set != 0) json["texCoord"] = use.set;
    if (use.transform != glm::mat3(1.0f)) {
        json["extensions"]["KHR_texture_transform"] = transform_json(use.transform);
        out.extensions.insert("KHR_texture_transform");
    }
    return json;
}

void set_use(Export& out, Json& json, const char* key, const TextureUse& use) {
    if (use.texture >= 0) json[key] = use_json(out, use);
}

// `json` is the extension of that name, which is used where it says anything.
void extend(Export& out, Json& material, const char* name, Json json) {
    if (json.empty()) return;
    material["extensions"][name] = std::move(json);
    out.extensions.insert(name);
}

Json specular_json(Export& out, const Material& m) {
    Json json = Json::object();
    if (m.specular != 1.0f) json["specularFactor"] = m.specular;
    if (m.specular_color != glm::vec3(1.0f)) json["specularColorFactor"] = to_json(m.specular_color);
    set_use(out, json, "specularTexture", m.specular_texture);
    set_use(out, json, "specularColorTexture", m.specular_color_texture);
    return json;
}

// Its thickness is for renderers that do not trace the other side; a solid has one of its own.
Json volume_json(const Material& m) {
    Json json = Json::object();
    if (m.thin) return json;
    json["thicknessFactor"] = 1.0f;
    if (std::isfinite(m.attenuation_distance)) json["attenuationDistance"] = m.attenuation_distance;
    if (m.attenuation_color != glm::vec3(1.0f)) json["attenuationColor"] = to_json(m.attenuation_color);
    return json;
}

Json clearcoat_json(Export& out, const Material& m) {
    Json json = Json::object();
    if (m.clearcoat == 0.0f) return json;
    json["clearcoatFactor"] = m.clearcoat;
    json["clearcoatRoughnessFactor"] = m.clearcoat_roughness;
    set_use(out, json, "clearcoatTexture", m.clearcoat_texture);
    set_use(out, json, "clearcoatRoughnessTexture", m.clearcoat_roughness_texture);
    return json;
}

void add_extensions(Export& out, Json& json, const Material& m) {
    Json transmission = Json::object();
    if (m.transmission != 0.0f) transmission["transmissionFactor"] = m.transmission;
    set_use(out, transmission, "transmissionTexture", m.transmission_texture);
    extend(out, json, "KHR_materials_transmission", std::move(transmission));
    // An index beyond all is written as 0, which means just that.
    if (m.ior != 1.5f) extend(out, json, "KHR_materials_ior", {{"ior", m.ior >= 1e4f ? 0.0f : m.ior}});
    extend(out, json, "KHR_materials_specular", specular_json(out, m));
    extend(out, json, "KHR_materials_volume", volume_json(m));
    extend(out, json, "KHR_materials_clearcoat", clearcoat_json(out, m));
}

Json material_json(Export& out, const Material& m) {
    Json json = Json::object();
    if (!m.name.empty()) json["name"] = m.name;
    const glm::vec4 base = glm::clamp(m.base_color, glm::vec4(0.0f), glm::vec4(1.0f));
    if (base != m.base_color) out.note("base colors above 1: cut");
    Json& pbr = json["pbrMetallicRoughness"];
    pbr = {{"baseColorFactor", {base.r, base.g, base.b, base.a}},
           {"metallicFactor", m.metallic},
           {"roughnessFactor", m.roughness}};
    set_use(out, pbr, "baseColorTexture", m.base_color_texture);
    set_use(out, pbr, "metallicRoughnessTexture", m.metallic_roughness_texture);
    set_use(out, json, "normalTexture", m.normal_texture);
    if (m.normal_texture.texture >= 0 && m.normal_scale != 1.0f)
        json["normalTexture"]["scale"] = m.normal_scale;
    set_use(out, json, "emissiveTexture", m.emission_texture);
    if (emits(m)) {
        const float strength = power_of_two_over(m.emission);
        json["emissiveFactor"] = to_json(m.emission / strength);
        if (strength != 1.0f)
            extend(out, json, "KHR_materials_emissive_strength", {{"emissiveStrength", strength}});
    }
    if (m.alpha_mode == AlphaMode::mask) json["alphaMode"] = "MASK", json["alphaCutoff"] = m.alpha_cutoff;
    if (m.alpha_mode == AlphaMode::blend) json["alphaMode"] = "BLEND";
    if (m.double_sided) json["doubleSided"] = true;
    add_extensions(out, json, m);
    return json;
}

} // namespace

float power_of_two_over(glm::vec3 color) {
    const float most = std::max({color.r, color.g, color.b});
    return most > 1.0f ? std::exp2(std::ceil(std::log2(most))) : 1.0f;
}

void add_textures(Export& out) {
    for (const Texture& texture : out.scene.textures) {
        if (texture.pixels.is_wide()) out.note("textures of 16 bits: rounded to 8");
        const std::vector<std::uint8_t> png = png_of(texture.pixels);
        Json image = {{"bufferView", out.buffer.add_view(std::as_bytes(std::span(png)), ViewOf::picture)},
                      {"mimeType", "image/png"}};
        if (!texture.name.empty()) image["name"] = texture.name;
        const std::size_t index = out.json["images"].size();
        out.json["images"].push_back(std::move(image));
        out.json["samplers"].push_back({{"magFilter", texture.nearest ? 9728 : 9729},
                                        {"wrapS", wrap_code(texture.wrap_u)},
                                        {"wrapT", wrap_code(texture.wrap_v)}});
        out.json["textures"].push_back({{"sampler", index}, {"source", index}});
    }
}

// Every reader appends a material for what has none: one of that name at the end is not written again.
void add_materials(Export& out) {
    const std::vector<Material>& all = out.scene.materials;
    const UsedParts used = used_parts(out.scene);
    std::size_t count = all.size();
    if (count > 0 && all.back().name == "default" && !used.materials.back()) --count;
    for (std::size_t i = 0; i < count; ++i) out.json["materials"].push_back(material_json(out, all[i]));
}

} // namespace luxel::gltf_export
