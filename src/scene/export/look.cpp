// SPDX-License-Identifier: MIT
#include "scene/export/look.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "scene/export/geometry.h"
#include "scene/surface.h"

namespace luxel {
namespace {

enum class Kind { color, number, radiance };

class Baker {
public:
    Baker(ExportOutput& out, const Material& material, std::size_t index)
        : out_(out), material_(material), index_(index) {}

    // `of` turns a texel, linear, into what the picture holds; without a texture, white into the constant.
    Channel channel(const char* name, const TextureUse& use, Kind kind,
                    const std::function<glm::vec3(glm::vec4)>& of) {
        Channel channel{.value = of(glm::vec4(1.0f))};
        if (use.texture < 0) return channel;
        const Texture& texture = out_.scene.textures[std::size_t(use.texture)];
        const Pixels& pixels = texture.pixels;
        if (pixels.width < 1 || pixels.height < 1) return channel;
        const TextureUse* leading = leading_texture(material_);
        if (use.set != leading->set || use.transform != leading->transform)
            out_.note("textures of one material with different coordinates: those of its first for all");

        Image picture(pixels.width, pixels.height, kind == Kind::number ? 1 : 3);
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x) {
                const glm::vec2 uv((float(x) + 0.5f) / float(picture.width),
                                   (float(y) + 0.5f) / float(picture.height));
                const glm::vec3 value = of(sample_texture(texture, uv));
                for (int c = 0; c < picture.channels; ++c)
                    picture.at(x, y)[c] =
                        kind == Kind::color ? srgb_encode(std::clamp(value[c], 0.0f, 1.0f)) : value[c];
            }
        channel.file =
            fmt::format("{}-{}-{}.{}", out_.stem, index_, name, kind == Kind::radiance ? "exr" : "png");
        if (kind == Kind::radiance)
            write_exr(out_.folder / channel.file, {{"", picture}});
        else
            write_png(out_.folder / channel.file, picture);
        channel.wrap_u = texture.wrap_u, channel.wrap_v = texture.wrap_v;
        channel.nearest = texture.nearest;
        return channel;
    }

private:
    ExportOutput& out_;
    const Material& material_;
    std::size_t index_;
};

glm::vec3 mean_vertex_color(const Scene& scene, std::size_t material) {
    glm::dvec3 sum(0.0);
    double count = 0;
    for (const Mesh& mesh : scene.meshes)
        if (std::size_t(mesh.material) == material)
            for (const glm::vec4& color : mesh.colors) sum += glm::dvec3(color), count += 1;
    return count > 0 ? glm::vec3(sum / count) : glm::vec3(1.0f);
}

void note_what_is_lost(ExportOutput& out, const Material& m) {
    if (m.specular_color != glm::vec3(1.0f) || m.specular_color_texture.texture >= 0)
        out.note("colors of dielectric reflection: white");
    if (m.specular_texture.texture >= 0) out.note("textures of dielectric reflection: left out");
    if (m.clearcoat > 0.0f) out.note("clear coats: left out");
    if (m.transmission_texture.texture >= 0 || (m.transmission > 0.0f && m.transmission < 1.0f))
        out.note("partial transmission: all or, below one half, nothing");
}

} // namespace

Look make_look(ExportOutput& out, std::size_t index, bool with_roughness) {
    const Material& m = out.scene.materials[index];
    const glm::vec3 tint = glm::vec3(m.base_color) * mean_vertex_color(out.scene, index);
    note_what_is_lost(out, m);
    Baker baker(out, m, index);
    Look look;
    look.color = baker.channel("color", m.base_color_texture, Kind::color,
                               [&](glm::vec4 t) { return tint * glm::vec3(t); });
    look.metallic = baker.channel("metallic", m.metallic_roughness_texture, Kind::number,
                                  [&](glm::vec4 t) { return glm::vec3(m.metallic * t.b); });
    look.alpha = baker.channel("alpha", m.metallic_roughness_texture, Kind::number,
                               [&](glm::vec4 t) { return glm::vec3(std::pow(m.roughness * t.g, 2.0f)); });
    look.roughness.value = glm::vec3(m.roughness);
    if (with_roughness)
        look.roughness = baker.channel("roughness", m.metallic_roughness_texture, Kind::number,
                                       [&](glm::vec4 t) { return glm::vec3(m.roughness * t.g); });
    if (m.metallic == 0.0f) look.metallic = {.value = glm::vec3(0.0f)};
    if (m.roughness == 0.0f) look.alpha = {.value = glm::vec3(0.0f)};
    if (emits(m))
        look.emission = baker.channel("emission", m.emission_texture, Kind::radiance,
                                      [&](glm::vec4 t) { return m.emission * glm::vec3(t); });
    else
        look.emission.value = glm::vec3(0.0f);
    if (m.alpha_mode != AlphaMode::opaque)
        look.coverage = baker.channel("coverage", m.base_color_texture, Kind::number, [&](glm::vec4 t) {
            const float alpha = m.base_color.a * t.a;
            return glm::vec3(m.alpha_mode == AlphaMode::blend ? alpha
                             : alpha >= m.alpha_cutoff        ? 1.0f
                                                              : 0.0f);
        });
    if (m.normal_texture.texture >= 0)
        look.normal_map = baker.channel("normal", m.normal_texture, Kind::radiance, [&](glm::vec4 t) {
            glm::vec3 n = glm::vec3(t) * 2.0f - 1.0f;
            n = glm::vec3(glm::vec2(n) * m.normal_scale, n.z);
            const float length = glm::length(n);
            return (length > 0 ? n / length : glm::vec3(0, 0, 1)) * 0.5f + 0.5f;
        });

    // The index whose reflectance at normal incidence is `specular` times that of the material's own.
    const float own = (m.ior - 1.0f) / (m.ior + 1.0f);
    const float f0 = std::sqrt(std::min(m.specular * own * own, 0.98f));
    look.ior = (1.0f + f0) / (1.0f - f0);
    look.reflects = f0 > 1e-3f;
    look.glass = m.transmission >= 0.5f;
    if (look.glass) look.ior = m.ior;
    if (look.glass && !m.thin && std::isfinite(m.attenuation_distance) && m.attenuation_distance > 0.0f)
        look.absorption = -glm::log(glm::max(m.attenuation_color, glm::vec3(1e-4f))) / m.attenuation_distance;
    return look;
}

} // namespace luxel
