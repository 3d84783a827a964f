// SPDX-License-Identifier: MIT
#include "scene/surface.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace luxel {
namespace {

struct Corners {
    std::uint32_t a, b, c;
    float wa, wb, wc; // barycentric weights
};

Corners corners_of(const Mesh& mesh, std::uint32_t triangle, glm::vec2 uv) {
    const std::uint32_t* index = &mesh.indices[std::size_t(triangle) * 3];
    return {index[0], index[1], index[2], 1.0f - uv.x - uv.y, uv.x, uv.y};
}

float largest_component(glm::vec3 v) { return std::max(std::max(v.x, v.y), v.z); }

template <class T> T interpolate(const std::vector<T>& values, const Corners& k) {
    return values[k.a] * k.wa + values[k.b] * k.wb + values[k.c] * k.wc;
}

// Texel indices on one axis and the weight of the second, as Vulkan's linear filter defines them.
struct Taps {
    int first, second;
    float weight;
};

Taps taps(float coordinate, int size, Wrap wrap) {
    // Bring the coordinate into one period first, so that its fraction keeps its bits.
    if (wrap == Wrap::repeat) coordinate -= std::floor(coordinate);
    if (wrap == Wrap::mirror) {
        coordinate -= 2.0f * std::floor(coordinate * 0.5f);
        if (coordinate > 1.0f) coordinate = 2.0f - coordinate;
    }
    float x = glm::clamp(coordinate, -1.0f, 2.0f) * float(size) - 0.5f;
    float low = std::floor(x);
    int first = int(low), second = first + 1;

    // Beside the border, repeating goes on at the other end; mirroring and clamping see the border texel
    // twice.
    if (wrap == Wrap::repeat) {
        if (first < 0) first += size;
        if (second >= size) second -= size;
    }
    return {glm::clamp(first, 0, size - 1), glm::clamp(second, 0, size - 1), x - low};
}

// 8-bit codes to linear values, for both kinds of texture.
struct DecodeTables {
    std::array<float, 256> srgb, linear;
    DecodeTables() {
        for (int i = 0; i < 256; ++i) {
            linear[std::size_t(i)] = float(i) / 255.0f;
            srgb[std::size_t(i)] = srgb_decode(linear[std::size_t(i)]);
        }
    }
};
const DecodeTables& decode_tables() {
    static const DecodeTables tables;
    return tables;
}

glm::vec4 texel(const Texture& texture, const std::array<float, 256>& color, int x, int y) {
    const Pixels8& p = texture.pixels;
    const std::uint8_t* t = &p.rgba[(std::size_t(y) * std::size_t(p.width) + std::size_t(x)) * 4];
    return {color[t[0]], color[t[1]], color[t[2]], float(t[3]) * (1.0f / 255.0f)};
}

// The texture of one slot at the hit; white where the slot is empty.
glm::vec4 look_up(const Scene& scene, const Mesh& mesh, const Corners& corners, const TextureUse& use) {
    if (use.texture < 0) return glm::vec4(1.0f);
    const std::vector<glm::vec2>& texcoords = mesh.texcoords[use.set];
    glm::vec2 uv = texcoords.empty() ? glm::vec2(0.0f) : interpolate(texcoords, corners);
    glm::vec2 transformed = glm::vec2(use.transform * glm::vec3(uv, 1.0f));
    return sample_texture(scene.textures[std::size_t(use.texture)], transformed);
}

// Rows are cross products of the columns: inverse transpose up to a positive factor, also for mirroring
// transforms.
glm::mat3 normal_matrix(const glm::mat4& transform, float& handedness) {
    glm::vec3 x(transform[0]), y(transform[1]), z(transform[2]);
    glm::mat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
    handedness = glm::dot(x, cofactors[0]) < 0.0f ? -1.0f : 1.0f;
    return cofactors * handedness;
}

glm::vec3 shading_normal(const Scene& scene, const Mesh& mesh, const Material& material,
                         const Instance& instance, const Corners& corners, glm::vec3 geometric_normal) {
    float handedness = 1.0f;
    glm::vec3 n = normal_matrix(instance.transform, handedness) * interpolate(mesh.normals, corners);
    float length = glm::length(n);
    if (!(length > 0.0f)) return geometric_normal; // opposite vertex normals that cancel
    n /= length;
    if (material.normal_texture.texture < 0 || mesh.tangents.empty()) return n;

    // Tangent frame as glTF defines it; a mirroring transform turns the bitangent around.
    glm::vec4 tangent = interpolate(mesh.tangents, corners);
    glm::vec3 t = glm::mat3(instance.transform) * glm::vec3(tangent);
    float tangent_length = glm::length(t);
    if (!(tangent_length > 0.0f)) return n;
    t /= tangent_length;
    glm::vec3 b = glm::cross(n, t) * (tangent.w < 0.0f ? -handedness : handedness);
    glm::vec3 m = glm::vec3(look_up(scene, mesh, corners, material.normal_texture)) * 2.0f - 1.0f;
    glm::vec3 bent = t * (m.x * material.normal_scale) + b * (m.y * material.normal_scale) + n * m.z;
    float bent_length = glm::length(bent);
    return bent_length > 0.0f ? bent / bent_length : n;
}

// Position, geometric normal and the clearance that their rounding asks for.
void place(Surface& s, const Mesh& mesh, const glm::mat4& transform, const Hit& hit, const Corners& k) {
    glm::vec3 a = transform_point(transform, mesh.positions[k.a]);
    glm::vec3 b = transform_point(transform, mesh.positions[k.b]);
    glm::vec3 c = transform_point(transform, mesh.positions[k.c]);
    s.offset = clearance(largest_component(glm::max(glm::max(glm::abs(a), glm::abs(b)), glm::abs(c))));
    s.geometric_normal = glm::normalize(hit.geometric_normal);

    // At an edge the same rounding could carry the point past the wall that meets it there: draw it inward by
    // a few clearances.
    float extent = largest_component(glm::max(glm::abs(b - a), glm::abs(c - a)));
    float inward = std::min(4.0f * s.offset / std::max(extent, 1e-30f), 0.1f) / 3.0f;
    float keep = 1.0f - 3.0f * inward;
    s.position = a * (k.wa * keep + inward) + b * (k.wb * keep + inward) + c * (k.wc * keep + inward);
}

// Factors times textures, and the lobes they make.
void shade(Surface& s, const Scene& scene, const Mesh& mesh, const Material& material, const Corners& k) {
    s.base_color = glm::vec3(material.base_color);
    if (material.base_color_texture.texture >= 0)
        s.base_color *= glm::vec3(look_up(scene, mesh, k, material.base_color_texture));
    if (!mesh.colors.empty()) s.base_color *= glm::vec3(interpolate(mesh.colors, k));

    s.metallic = material.metallic, s.roughness = material.roughness;
    if (material.metallic_roughness_texture.texture >= 0) {
        glm::vec4 t = look_up(scene, mesh, k, material.metallic_roughness_texture);
        s.roughness *= t.g, s.metallic *= t.b;
    }
    s.transmission = material.transmission;
    if (s.transmission > 0.0f) s.transmission *= look_up(scene, mesh, k, material.transmission_texture).r;
    s.transmission *= 1.0f - s.metallic;
    s.specular = material.specular * look_up(scene, mesh, k, material.specular_texture).a;
    s.specular_color =
        material.specular_color * glm::vec3(look_up(scene, mesh, k, material.specular_color_texture));
    s.emission = material.emission;
    if (material.emission_texture.texture >= 0 && s.emission != glm::vec3(0.0f))
        s.emission *= glm::vec3(look_up(scene, mesh, k, material.emission_texture));

    shared::Brdf brdf =
        shared::make_brdf(s.base_color, s.metallic, s.roughness, material.ior, s.specular, s.specular_color);
    s.brdf = shared::scale_brdf(brdf, 1.0f - s.transmission);
}

} // namespace

glm::vec4 sample_texture(const Texture& texture, glm::vec2 uv) {
    const DecodeTables& tables = decode_tables();
    const std::array<float, 256>& color = texture.srgb ? tables.srgb : tables.linear;
    Taps x = taps(uv.x, texture.pixels.width, texture.wrap_u);
    Taps y = taps(uv.y, texture.pixels.height, texture.wrap_v);
    if (texture.nearest)
        return texel(texture, color, x.weight < 0.5f ? x.first : x.second,
                     y.weight < 0.5f ? y.first : y.second);
    glm::vec4 top =
        glm::mix(texel(texture, color, x.first, y.first), texel(texture, color, x.second, y.first), x.weight);
    glm::vec4 bottom = glm::mix(texel(texture, color, x.first, y.second),
                                texel(texture, color, x.second, y.second), x.weight);
    return glm::mix(top, bottom, y.weight);
}

glm::vec3 emission_at(const Scene& scene, std::uint32_t instance, std::uint32_t triangle, glm::vec2 uv) {
    const Mesh& mesh = scene.meshes[std::size_t(scene.instances[instance].mesh)];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    if (material.emission_texture.texture < 0) return material.emission;
    Corners corners = corners_of(mesh, triangle, uv);
    return material.emission * glm::vec3(look_up(scene, mesh, corners, material.emission_texture));
}

bool is_transparent(const Scene& scene, std::uint32_t instance, std::uint32_t triangle, glm::vec2 uv) {
    const Mesh& mesh = scene.meshes[std::size_t(scene.instances[instance].mesh)];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    if (material.alpha_mode == AlphaMode::opaque) return false;
    Corners corners = corners_of(mesh, triangle, uv);
    float alpha = material.base_color.a * look_up(scene, mesh, corners, material.base_color_texture).a;
    if (!mesh.colors.empty()) alpha *= interpolate(mesh.colors, corners).a;
    return alpha < (material.alpha_mode == AlphaMode::mask ? material.alpha_cutoff : 0.5f);
}

Surface surface_at(const Scene& scene, const Hit& hit, glm::vec3 direction) {
    const Instance& instance = scene.instances[hit.instance];
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    Corners corners = corners_of(mesh, hit.triangle, {hit.u, hit.v});

    Surface s;
    s.material = &material;
    place(s, mesh, instance.transform, hit, corners);
    s.front = glm::dot(s.geometric_normal, direction) < 0.0f;

    // Bend on the side that the ray sees, then turn back.
    float side = s.front ? 1.0f : -1.0f;
    glm::vec3 n = shading_normal(scene, mesh, material, instance, corners, s.geometric_normal);
    s.normal = shared::facing_normal(n * side, s.geometric_normal * side, -glm::normalize(direction)) * side;
    shade(s, scene, mesh, material, corners);
    return s;
}

} // namespace luxel
