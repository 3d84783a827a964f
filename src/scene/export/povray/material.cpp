// SPDX-License-Identifier: MIT
// Materials: the Lambertian lobe baked into one picture, ideal mirrors and glass, emission.
#include <algorithm>

#include "core/parallel.h"
#include "scene/export/povray/text.h"
#include "scene/printable.h"
#include "scene/surface.h"
#include "shared/brdf.h"

namespace luxel::povray {
namespace {

glm::vec4 read(const Scene& scene, const TextureUse& use, glm::vec2 uv) {
    if (use.texture < 0) return glm::vec4(1.0f);
    return sample_texture(scene.textures[std::size_t(use.texture)], uv);
}

glm::vec3 mean_emission(const Scene& scene, const Material& material) {
    if (material.emission_texture.texture < 0) return material.emission;
    constexpr int side = 16;
    glm::vec3 sum(0.0f);
    for (int i = 0; i < side * side; ++i)
        sum += glm::vec3(read(scene, material.emission_texture,
                              (glm::vec2(float(i % side), float(i / side)) + 0.5f) / float(side)));
    return material.emission * sum / float(side * side);
}

bool is_mirror(const Material& m) {
    return m.metallic_roughness_texture.texture < 0 && shared::is_mirror(m.metallic, m.roughness);
}

bool is_glass(const Export& out, const Material& m) { return out.settings.specular && m.transmission > 0.0f; }

// What surfaces do beside the Lambertian lobe.
std::string finish_of(const Export& out, const Material& m, glm::vec3 pigment) {
    std::string finish = "diffuse 1";
    if (m.emission != glm::vec3(0.0f))
        finish += " emission " + rgb(mean_emission(out.scene, m) / glm::max(pigment, glm::vec3(1e-3f)));
    if (!out.settings.specular) return finish;
    if (is_mirror(m) && m.metallic > 0.0f)
        finish += " reflection { " + rgb(glm::vec3(m.base_color) * m.metallic) + " }";
    else if (is_glass(out, m))
        finish += " reflection { 0, 1 fresnel on } conserve_energy";
    return finish;
}

void note_what_is_lost(Export& out, const Material& m) {
    if (!out.settings.specular && (m.metallic > 0.0f || m.transmission > 0.0f))
        out.note("mirrors and glass: left out on request");
    if (m.roughness < 1.0f && m.specular > 0.0f && !is_mirror(m))
        out.note("glossy lobes: left out; only the Lambertian lobe, ideal mirrors and glass are there");
    if (m.normal_texture.texture >= 0) out.note("normal maps: left out");
    if (m.emission_texture.texture >= 0) out.note("textures of emission: their mean");
    if (m.emission != glm::vec3(0.0f)) out.note("emitters: seen from behind they glow as well");
    if (m.base_color_texture.texture < 0) {
        if (m.metallic_roughness_texture.texture >= 0 || m.transmission_texture.texture >= 0)
            out.note("textures of metalness and transmission without one of base color: read at one place");
        return;
    }
    for (const TextureUse* use : {&m.metallic_roughness_texture, &m.specular_texture,
                                  &m.specular_color_texture, &m.transmission_texture})
        if (use->texture >= 0 &&
            (use->set != m.base_color_texture.set || use->transform != m.base_color_texture.transform))
            out.note("textures of one material with different coordinates: those of its base color for all");
    const Texture& texture = out.scene.textures[std::size_t(m.base_color_texture.texture)];
    if (texture.wrap_u != Wrap::repeat || texture.wrap_v != Wrap::repeat)
        out.note("textures that are clamped or mirrored: repeated");
}

// The lobe's albedo on the grid of the base color texture, as a picture beside the file.
std::string bake(const Export& out, const Material& material, std::size_t index) {
    const Pixels& pixels = out.scene.textures[std::size_t(material.base_color_texture.texture)].pixels;
    const bool masked = material.alpha_mode != AlphaMode::opaque;
    Image picture(pixels.width, pixels.height, masked ? 4 : 3);
    parallel_for(std::size_t(pixels.height), 8, [&](std::size_t y) {
        for (int x = 0; x < pixels.width; ++x) {
            const glm::vec2 uv((float(x) + 0.5f) / float(pixels.width),
                               (float(y) + 0.5f) / float(pixels.height));
            const glm::vec4 albedo = diffuse_albedo(out.scene, material, uv, glm::vec4(1.0f));
            float* pixel = picture.at(x, int(y));
            for (int c = 0; c < 3; ++c) pixel[c] = srgb_encode(glm::clamp(albedo[c], 0.0f, 1.0f));
            if (masked) pixel[3] = albedo.a;
        }
    });
    const std::string name = fmt::format("{}-{}.png", out.stem, index);
    write_png(out.folder / name, picture);
    return name;
}

} // namespace

glm::vec4 diffuse_albedo(const Scene& scene, const Material& m, glm::vec2 uv, glm::vec4 vertex_color) {
    const glm::vec4 base = m.base_color * read(scene, m.base_color_texture, uv) * vertex_color;
    const glm::vec4 metallic_roughness = read(scene, m.metallic_roughness_texture, uv);
    const float metallic = m.metallic * metallic_roughness.b;
    const float transmission = m.transmission * (1.0f - metallic) * read(scene, m.transmission_texture, uv).r;
    const shared::Brdf brdf =
        shared::make_brdf(glm::vec3(base), metallic, m.roughness * metallic_roughness.g, m.ior,
                          m.specular * read(scene, m.specular_texture, uv).a,
                          m.specular_color * glm::vec3(read(scene, m.specular_color_texture, uv)));
    const float cutoff = m.alpha_mode == AlphaMode::mask ? m.alpha_cutoff : 0.5f;
    const bool hole = m.alpha_mode != AlphaMode::opaque && base.a < cutoff;
    return {brdf.diffuse * (1.0f - transmission), hole ? 0.0f : 1.0f};
}

std::string texture_of(const Export& out, const Material& m, glm::vec3 diffuse) {
    // Emission is a factor on the pigment, so that must not be black where light comes from.
    if (m.emission != glm::vec3(0.0f)) diffuse = glm::max(diffuse, glm::vec3(1e-3f));
    const std::string transmit =
        is_glass(out, m) ? fmt::format(" transmit {:.7g}", m.transmission * (1.0f - m.metallic)) : "";
    return fmt::format("pigment {{ {}{} }} finish {{ {} }}", rgb(diffuse), transmit,
                       finish_of(out, m, diffuse));
}

std::string interior_of(const Export& out, const Material& m) {
    if (!is_glass(out, m)) return "";
    return fmt::format(" interior {{ ior {:.7g} }}", m.thin ? 1.0f : m.ior);
}

void declare_material(Export& out, std::size_t index) {
    const Material& m = out.scene.materials[index];
    note_what_is_lost(out, m);
    const glm::vec4 plain = diffuse_albedo(out.scene, m, glm::vec2(0.5f), glm::vec4(1.0f));
    out.add("// {}\n#declare T{} = texture {{ ", ascii(m.name), index);
    if (m.base_color_texture.texture < 0 || m.emission != glm::vec3(0.0f))
        out.add("{} }}\n", texture_of(out, m, glm::vec3(plain)));
    else
        out.add(
            "uv_mapping pigment {{ image_map {{ png \"{}\" gamma srgb interpolate 2 }} }} finish {{ {} }} "
            "}}\n",
            bake(out, m, index), finish_of(out, m, glm::vec3(1.0f)));
}

} // namespace luxel::povray
