// SPDX-License-Identifier: MIT
#include "scene/obj_material.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <tiny_obj_loader.h>

#include "core/error.h"
#include "scene/load_texture.h"
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

// One texture per file and role.
class Textures {
public:
    explicit Textures(const Folder& folder) : folder_(folder) {}

    TextureUse use(const std::string& file, const tinyobj::texture_option_t& options, TextureRole role) {
        TextureUse use;
        if (file.empty()) return use;
        const auto [entry, added] =
            known_.emplace(std::tuple(file, role, options.clamp), int(requests_.size()));
        if (added) {
            TextureRequest& request = requests_.emplace_back();
            request.texture.name = request.image = printable(file);
            request.texture.wrap_u = request.texture.wrap_v = options.clamp ? Wrap::clamp : Wrap::repeat;
            request.role = role;
            request.read = [this, path = obj_path(file)] { return folder_.read(path, max_image_file_bytes); };
        }
        use.texture = entry->second;

        // uv' = offset + scale * uv with v up, restated for v down.
        const auto &s = options.scale, &o = options.origin_offset;
        use.transform = glm::mat3(s[0], 0, 0, 0, s[1], 0, o[0], 1.0f - s[1] - o[1], 1);
        return use;
    }

    LoadedTextures load(const std::string& source, const LoadOptions& options) {
        return load_textures(std::move(requests_), source, options);
    }

private:
    const Folder& folder_;
    std::map<std::tuple<std::string, TextureRole, bool>, int> known_;
    std::vector<TextureRequest> requests_;
};

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

Material convert(const tinyobj::material_t& m, Textures& textures, const std::string& source) {
    Material out;
    out.name = printable(m.name);
    out.metallic = 0.0f;
    out.roughness = 1.0f;
    out.specular = 0.0f;
    out.base_color = glm::vec4(glm::min(color(m.diffuse, source, out.name), glm::vec3(1.0f)), 1.0f);
    out.base_color_texture = textures.use(m.diffuse_texname, m.diffuse_texopt, TextureRole::color);
    // Exporters leave Kd black where the map is to be the color.
    if (out.base_color_texture.texture >= 0 && largest(glm::vec3(out.base_color)) == 0.0f)
        out.base_color = glm::vec4(1.0f);
    out.emission = color(m.emission, source, out.name);
    out.emission_texture = textures.use(m.emissive_texname, m.emissive_texopt, TextureRole::color);
    if (out.emission_texture.texture >= 0 && largest(out.emission) == 0.0f) out.emission = glm::vec3(1.0f);
    out.normal_texture = textures.use(m.normal_texname, m.normal_texopt, TextureRole::normal);

    const glm::vec3 specular = color(m.specular, source, out.name);
    if (largest(specular) > 0.0f) {
        const float alpha = std::sqrt(2.0f / (std::clamp(m.shininess, 0.0f, 1e8f) + 2.0f));
        out.roughness = std::sqrt(alpha);
        out.specular = std::min(largest(specular), 1.0f);
        out.specular_color = specular / largest(specular);
    }
    set_transmission(m, color(m.transmittance, source, out.name), out);
    if (is_glass(m) && largest(specular) == 0.0f) out.roughness = 0.0f;

    // A cut-out mask is understood when it is the color image's own alpha channel.
    if (!m.alpha_texname.empty() && m.alpha_texname == m.diffuse_texname) out.alpha_mode = AlphaMode::mask;
    return out;
}

} // namespace

void read_obj_materials(Scene& scene, const std::vector<tinyobj::material_t>& materials, const Folder& folder,
                        const std::string& source_name, const LoadOptions& options) {
    Textures textures(folder);
    for (const tinyobj::material_t& m : materials) {
        scene.materials.push_back(convert(m, textures, source_name));
        if (!m.alpha_texname.empty() && m.alpha_texname != m.diffuse_texname)
            scene.warnings.push_back(fmt::format("{}: material \"{}\": map_d is left out", source_name,
                                                 scene.materials.back().name));
    }
    Material& plain = scene.materials.emplace_back();
    plain.name = "default";
    plain.base_color = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
    plain.metallic = plain.specular = 0.0f;

    LoadedTextures loaded = textures.load(source_name, options);
    scene.textures = std::move(loaded.textures);
    for (const std::string& warning : loaded.warnings)
        scene.warnings.push_back(fmt::format("{}: {}", source_name, warning));
}

std::string obj_path(std::string_view path) {
    std::string result(path);
    std::replace(result.begin(), result.end(), '\\', '/');
    return result;
}

} // namespace luxel
