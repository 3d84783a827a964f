// SPDX-License-Identifier: MIT
#include "scene/obj_textures.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <tiny_obj_loader.h>

#include "core/error.h"
#include "core/parallel.h"
#include "scene/obj_material.h"
#include "scene/printable.h"
#include "scene/surface.h"
#include "scene/texture_filter.h"

namespace luxel {
namespace {

float number_of(const glm::vec4& texel, char channel) {
    switch (channel) {
    case 'r':
        return texel.r;
    case 'g':
        return texel.g;
    case 'b':
        return texel.b;
    case 'a':
        return texel.a;
    default:
        return luminance(glm::vec3(texel));
    }
}

// Texel (x, y) of a grid of `size` on a texture, which may have another size.
glm::vec4 resampled(const Texture& texture, glm::ivec2 size, int x, int y) {
    if (texture.pixels.width == size.x && texture.pixels.height == size.y) return texel(texture, x, y);
    return sample_texture(texture, (glm::vec2(x, y) + 0.5f) / glm::vec2(size));
}

// A texture of 16 bits from values as a file would store them.
Texture make_texture(const Texture& like, glm::ivec2 size, const std::function<glm::vec4(int, int)>& value) {
    Texture out = like;
    out.pixels = {};
    out.pixels.width = size.x, out.pixels.height = size.y;
    out.pixels.wide.resize(std::size_t(size.x) * std::size_t(size.y) * 4);
    parallel_for(std::size_t(size.y), 16, [&](std::size_t y) {
        for (int x = 0; x < size.x; ++x) {
            const glm::vec4 v = value(x, int(y));
            for (int c = 0; c < 4; ++c)
                out.pixels.wide[(y * std::size_t(size.x) + std::size_t(x)) * 4 + std::size_t(c)] =
                    std::uint16_t(std::lround(std::clamp(v[c], 0.0f, 1.0f) * 65535.0f));
        }
    });
    return out;
}

// Whether a map for "bump" holds normals: some exporters write those there.
// Heights are gray.
bool holds_normals(const Texture& texture) {
    const Pixels& p = texture.pixels;
    double blue = 0.0;
    bool colored = false;
    const std::size_t count = std::size_t(p.width) * std::size_t(p.height);
    for (std::size_t i = 0; i < count; ++i) {
        const float r = p.value(4 * i), g = p.value(4 * i + 1), b = p.value(4 * i + 2);
        colored |= std::max(std::abs(r - g), std::abs(g - b)) > 0.05f;
        blue += double(b);
    }
    return colored && blue > 0.6 * double(count);
}

int wrapped(int i, int size, Wrap wrap) {
    return wrap == Wrap::clamp ? std::clamp(i, 0, size - 1) : (i + size) % size;
}

constexpr TextureUse Material::*slots[] = {&Material::base_color_texture,
                                           &Material::metallic_roughness_texture,
                                           &Material::normal_texture,
                                           &Material::emission_texture,
                                           &Material::specular_texture,
                                           &Material::specular_color_texture,
                                           &Material::transmission_texture,
                                           &Material::clearcoat_texture,
                                           &Material::clearcoat_roughness_texture,
                                           &Material::height_texture};

// Drops textures that no material uses any more.
void keep_used(Scene& scene) {
    std::vector<int> place(scene.textures.size(), -1);
    std::vector<Texture> kept;
    for (Material& m : scene.materials)
        for (const auto slot : slots) {
            int& texture = (m.*slot).texture;
            if (texture < 0) continue;
            int& there = place[std::size_t(texture)];
            if (there < 0) {
                there = int(kept.size());
                kept.push_back(std::move(scene.textures[std::size_t(texture)]));
            }
            texture = there;
        }
    scene.textures = std::move(kept);
}

} // namespace

TextureUse ObjTextures::use(const std::string& file, const tinyobj::texture_option_t& options,
                            TextureRole role) {
    TextureUse use;
    if (file.empty()) return use;
    const auto [entry, added] = known_.emplace(std::tuple(file, role, options.clamp), int(requests_.size()));
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

ObjTextures::Numbers ObjTextures::numbers(const std::string& file, const tinyobj::texture_option_t& options) {
    return {use(file, options, TextureRole::data), options.imfchan};
}

void ObjTextures::combine_metallic_roughness(std::size_t material, const Numbers& metallic,
                                             const Numbers& roughness) {
    if (metallic || roughness)
        combinations_.push_back({Kind::metallic_roughness, material, metallic, roughness});
}

void ObjTextures::combine_alpha(std::size_t material, const Numbers& alpha) {
    combinations_.push_back({Kind::alpha, material, alpha, {}});
}

void ObjTextures::make_normals(std::size_t material, const Numbers& heights, float scale) {
    combinations_.push_back({Kind::normals, material, heights, {}, scale});
}

Texture ObjTextures::combine(const std::vector<Texture>& textures, const Combination& c, Material& material,
                             std::vector<std::string>& notes) const {
    const auto texture_of = [&](const TextureUse& use) {
        return use.texture >= 0 ? &textures[std::size_t(use.texture)] : nullptr;
    };
    const Texture* first = texture_of(c.first.use);
    if (c.kind == Kind::normals) {
        material.normal_texture = c.first.use;
        if (!holds_normals(*first)) return normals_of_heights(*first, c.first.channel, c.scale);
        notes.push_back(
            fmt::format("{}: named as a bump map, it holds normals and is read as such", first->name));
        return *first;
    }

    const bool alpha = c.kind == Kind::alpha;
    const TextureUse other = alpha ? material.base_color_texture : c.second.use;
    const Texture* second = texture_of(other);
    if (first && second && (c.first.use.transform != other.transform || first->wrap_u != second->wrap_u))
        notes.push_back(fmt::format("{}: placed otherwise than {}, with which it "
                                    "makes one texture; read as that",
                                    first->name, second->name));
    const Texture& like = second ? *second : *first;
    const glm::ivec2 size(std::max(first ? first->pixels.width : 1, second ? second->pixels.width : 1),
                          std::max(first ? first->pixels.height : 1, second ? second->pixels.height : 1));
    TextureUse& slot = alpha ? material.base_color_texture : material.metallic_roughness_texture;
    slot = second ? other : c.first.use;
    const auto number = [&](const Texture* texture, char channel, int x, int y) {
        return texture ? number_of(resampled(*texture, size, x, y), channel) : 1.0f;
    };
    if (!alpha)
        return make_texture(like, size, [&](int x, int y) {
            return glm::vec4(1.0f, number(second, c.second.channel, x, y),
                             number(first, c.first.channel, x, y), 1.0f);
        });

    // Alpha is a number, colors stay coded as the file has them.
    const bool own_alpha = first->pixels.has_alpha;
    Texture out = make_texture(like, size, [&](int x, int y) {
        const glm::vec4 color = second ? resampled(*second, size, x, y) : glm::vec4(1.0f);
        return glm::vec4(srgb_encode(color.r), srgb_encode(color.g), srgb_encode(color.b),
                         number(first, own_alpha ? 'a' : c.first.channel, x, y));
    });
    out.srgb = true;
    out.pixels.has_alpha = true;
    return out;
}

void ObjTextures::finish(Scene& scene, const std::string& source, const LoadOptions& options) {
    LoadedTextures loaded = load_textures(std::move(requests_), source, options);
    scene.textures = std::move(loaded.textures);
    for (const Combination& c : combinations_) {
        Material& material = scene.materials[c.material];
        Texture made = combine(scene.textures, c, material, loaded.warnings);
        TextureUse& slot = c.kind == Kind::alpha                ? material.base_color_texture
                           : c.kind == Kind::metallic_roughness ? material.metallic_roughness_texture
                                                                : material.normal_texture;
        slot.texture = int(scene.textures.size());
        scene.textures.push_back(std::move(made));
    }
    keep_used(scene);
    for (const std::string& warning : loaded.warnings)
        scene.warnings.push_back(fmt::format("{}: {}", source, warning));
}

Texture normals_of_heights(const Texture& heights, char channel, float scale) {
    const glm::ivec2 size(heights.pixels.width, heights.pixels.height);
    const auto height = [&](int x, int y) {
        return number_of(
            texel(heights, wrapped(x, size.x, heights.wrap_u), wrapped(y, size.y, heights.wrap_v)), channel);
    };
    // Rows go down where the bitangent goes up.
    Texture out = make_texture(heights, size, [&](int x, int y) {
        const glm::vec3 n =
            glm::normalize(glm::vec3(-0.5f * scale * (height(x + 1, y) - height(x - 1, y)),
                                     0.5f * scale * (height(x, y + 1) - height(x, y - 1)), 1.0f));
        return glm::vec4(n * 0.5f + 0.5f, 1.0f);
    });
    out.srgb = false;
    return out;
}

} // namespace luxel
