// SPDX-License-Identifier: MIT
#include "scene/obj_material.h"

#include <algorithm>
#include <cmath>

#include <tiny_obj_loader.h>

#include "core/error.h"
#include "scene/obj_textures.h"
#include "scene/printable.h"

namespace luxel {
namespace {

glm::vec3 color(const float (&c)[3], const std::string& source, const std::string& material) {
    for (const float v : c)
        if (!(std::isfinite(v) && v >= 0.0f))
            fail(Fault::bad_input, "{}: material \"{}\": a color is negative or not finite", source,
                 material);
    return {c[0], c[1], c[2]};
}

float largest(glm::vec3 v) { return std::max({v.x, v.y, v.z}); }

bool is_glass(const tinyobj::material_t& m) { return m.illum == 4 || m.illum == 6 || m.illum == 7; }

// Glass: Tf tints what passes, white where the file says nothing.
void set_transmission(const tinyobj::material_t& m, glm::vec3 filter, Material& out) {
    if (!(m.dissolve < 1.0f) && !is_glass(m)) return;
    out.transmission = m.dissolve < 1.0f ? std::clamp(1.0f - m.dissolve, 0.0f, 1.0f) : 1.0f;
    out.ior = std::isfinite(m.ior) ? std::max(m.ior, 1.0f) : 1.0f;
    out.thin = out.ior == 1.0f;
    out.specular = 1.0f;
    out.specular_color = glm::vec3(1.0f);
    const glm::vec3 tint = largest(filter) > 0.0f ? filter : glm::vec3(1.0f);
    out.base_color =
        glm::vec4(glm::mix(glm::vec3(out.base_color), glm::min(tint, glm::vec3(1.0f)), out.transmission), 1);
}

float share(float v) { return std::isfinite(v) ? std::clamp(v, 0.0f, 1.0f) : 0.0f; }

float roughness_of(float shininess) {
    return std::pow(2.0f / (std::clamp(shininess, 0.0f, 1e8f) + 2.0f), 0.25f);
}

// The statements of one material and what becomes of them.
class Converter {
public:
    Converter(const tinyobj::material_t& m, const MtlStatements& statements, LeftOut& left_out,
              ObjTextures& textures, const std::string& source, std::size_t index)
        : m_(m), statements_(statements), left_out_(left_out), textures_(textures), source_(source),
          index_(index) {}

    Material run() {
        out_.name = printable(m_.name);
        set_color();
        const glm::vec3 specular = color(m_.specular, source_, out_.name);
        if (has("Pr") || has("Pm") || has("map_Pr") || has("map_Pm"))
            set_physical();
        else
            set_specular(specular);
        set_transmission(m_, color(m_.transmittance, source_, out_.name), out_);
        if (is_glass(m_) && !has("Pr") && largest(specular) == 0.0f) out_.roughness = 0.0f;
        out_.clearcoat = share(m_.clearcoat_thickness);
        out_.clearcoat_roughness = share(m_.clearcoat_roughness);
        set_normals();
        set_cut_out();
        return out_;
    }

private:
    bool has(std::string_view keyword) const { return statements_.has(m_.name, keyword); }

    void set_color() {
        out_.base_color = glm::vec4(glm::min(color(m_.diffuse, source_, out_.name), glm::vec3(1.0f)), 1.0f);
        out_.base_color_texture = textures_.use(m_.diffuse_texname, m_.diffuse_texopt, TextureRole::color);
        // Exporters leave Kd black where the map is to be the color.
        if (out_.base_color_texture.texture >= 0 && largest(glm::vec3(out_.base_color)) == 0.0f)
            out_.base_color = glm::vec4(1.0f);
        out_.emission = color(m_.emission, source_, out_.name);
        out_.emission_texture = textures_.use(m_.emissive_texname, m_.emissive_texopt, TextureRole::color);
        if (out_.emission_texture.texture >= 0 && largest(out_.emission) == 0.0f)
            out_.emission = glm::vec3(1.0f);
    }

    void set_specular(glm::vec3 specular) {
        out_.metallic = 0.0f, out_.roughness = 1.0f, out_.specular = 0.0f;
        // As with Kd, a map alone is not made black by a factor that nobody stated.
        if (!m_.specular_texname.empty() && !has("Ks")) specular = glm::vec3(1.0f);
        if (largest(specular) == 0.0f) return;
        out_.roughness = roughness_of(m_.shininess);
        out_.specular = std::min(largest(specular), 1.0f);
        out_.specular_color = specular / largest(specular);
        out_.specular_color_texture =
            textures_.use(m_.specular_texname, m_.specular_texopt, TextureRole::color);
    }

    // Factors of 0 beside a map are those that exporters write for want of
    // another.
    void set_physical() {
        for (const char* keyword : {"Ks", "map_Ks"})
            if (has(keyword)) left_out_.add(keyword);
        if (has("Ns") && has("Pr")) left_out_.add("Ns");
        const auto metallic = textures_.numbers(m_.metallic_texname, m_.metallic_texopt);
        const auto roughness = textures_.numbers(m_.roughness_texname, m_.roughness_texopt);
        out_.metallic = metallic && !(m_.metallic > 0.0f) ? 1.0f : share(m_.metallic);
        out_.roughness = has("Pr") ? share(m_.roughness) : has("Ns") ? roughness_of(m_.shininess) : 1.0f;
        if (roughness && (!has("Pr") || out_.roughness == 0.0f)) out_.roughness = 1.0f;
        textures_.combine_metallic_roughness(index_, metallic, roughness);
        if (has("Ni") && std::isfinite(m_.ior) && m_.ior > 1.0f) out_.ior = m_.ior;
    }

    void set_normals() {
        out_.normal_texture = textures_.use(m_.normal_texname, m_.normal_texopt, TextureRole::normal);
        if (m_.bump_texname.empty()) return;
        if (out_.normal_texture.texture >= 0) return left_out_.add("bump beside norm");
        const float scale =
            std::isfinite(m_.bump_texopt.bump_multiplier) ? m_.bump_texopt.bump_multiplier : 1.0f;
        const auto heights = textures_.numbers(m_.bump_texname, m_.bump_texopt);
        textures_.make_normals(index_, heights, scale);
        out_.normal_texture = heights.use; // asks for tangents
    }

    // The color image's own alpha channel, or an image of its own.
    void set_cut_out() {
        if (m_.alpha_texname.empty()) return;
        out_.alpha_mode = AlphaMode::mask;
        if (m_.alpha_texname != m_.diffuse_texname)
            textures_.combine_alpha(index_, textures_.numbers(m_.alpha_texname, m_.alpha_texopt));
    }

    const tinyobj::material_t& m_;
    const MtlStatements& statements_;
    LeftOut& left_out_;
    ObjTextures& textures_;
    const std::string& source_;
    std::size_t index_;
    Material out_;
};

} // namespace

void read_obj_materials(Scene& scene, const std::vector<tinyobj::material_t>& materials,
                        const MtlStatements& statements, LeftOut& left_out, const Folder& folder,
                        const std::string& source_name, const LoadOptions& options) {
    ObjTextures textures(folder);
    for (const tinyobj::material_t& m : materials) {
        const std::size_t index = scene.materials.size();
        scene.materials.push_back(Converter(m, statements, left_out, textures, source_name, index).run());
    }
    Material& plain = scene.materials.emplace_back();
    plain.name = "default";
    plain.base_color = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
    plain.metallic = plain.specular = 0.0f;
    textures.finish(scene, source_name, options);
}

std::string obj_path(std::string_view path) {
    std::string result(path);
    std::replace(result.begin(), result.end(), '\\', '/');
    return result;
}

} // namespace luxel
