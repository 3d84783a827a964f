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

// std::floor is a call on processors without SSE 4.1.
float floor_of(float x) {
    if (!(std::abs(x) < 8388608.0f)) return x; // no fraction left
    float truncated = float(int(x));
    return truncated > x ? truncated - 1.0f : truncated;
}

Taps taps(float coordinate, int size, Wrap wrap) {
    // Bring the coordinate into one period first, so that its fraction keeps its bits.
    if (wrap == Wrap::repeat) coordinate -= floor_of(coordinate);
    if (wrap == Wrap::mirror) {
        coordinate -= 2.0f * floor_of(coordinate * 0.5f);
        if (coordinate > 1.0f) coordinate = 2.0f - coordinate;
    }
    float x = glm::clamp(coordinate, -1.0f, 2.0f) * float(size) - 0.5f;
    float low = floor_of(x);
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

const std::uint8_t* texel_address(const Texture& texture, int x, int y) {
    const Pixels8& p = texture.pixels;
    return &p.rgba[(std::size_t(y) * std::size_t(p.width) + std::size_t(x)) * 4];
}

glm::vec4 texel(const Texture& texture, const std::array<float, 256>& color, int x, int y) {
    const std::uint8_t* t = texel_address(texture, x, y);
    return {color[t[0]], color[t[1]], color[t[2]], float(t[3]) * (1.0f / 255.0f)};
}

// The texels that a lookup will read. Finding them is apart from reading them because the first read of each
// misses the cache: all are asked for at once, and fetched while geometry is computed.
struct Footprint {
    const Texture* texture = nullptr;
    Taps x, y; // unset without a texture
};

Footprint footprint(const Texture& texture, glm::vec2 uv) {
    return {&texture, taps(uv.x, texture.pixels.width, texture.wrap_u),
            taps(uv.y, texture.pixels.height, texture.wrap_v)};
}

glm::vec4 filter(const Footprint& f) {
    const DecodeTables& tables = decode_tables();
    const std::array<float, 256>& color = f.texture->srgb ? tables.srgb : tables.linear;
    if (f.texture->nearest)
        return texel(*f.texture, color, f.x.weight < 0.5f ? f.x.first : f.x.second,
                     f.y.weight < 0.5f ? f.y.first : f.y.second);
    glm::vec4 top = glm::mix(texel(*f.texture, color, f.x.first, f.y.first),
                             texel(*f.texture, color, f.x.second, f.y.first), f.x.weight);
    glm::vec4 bottom = glm::mix(texel(*f.texture, color, f.x.first, f.y.second),
                                texel(*f.texture, color, f.x.second, f.y.second), f.x.weight);
    return glm::mix(top, bottom, f.y.weight);
}

// What a slot reads at a hit whose coordinates of both sets are `uv`.
Footprint locate(const Scene& scene, const TextureUse& use, const glm::vec2 (&uv)[2]) {
    if (use.texture < 0) return {};
    glm::vec2 transformed(use.transform * glm::vec3(uv[use.set], 1.0f));
    Footprint f = footprint(scene.textures[std::size_t(use.texture)], transformed);
    __builtin_prefetch(texel_address(*f.texture, f.x.first, f.y.first));
    __builtin_prefetch(texel_address(*f.texture, f.x.first, f.y.second));
    return f;
}

struct Texcoords {
    Texcoords(const Mesh& mesh, const Corners& k) {
        for (int set : {0, 1})
            uv[set] = mesh.texcoords[set].empty() ? glm::vec2(0.0f) : interpolate(mesh.texcoords[set], k);
    }
    glm::vec2 uv[2];
};

bool is_textured(const Material& m) {
    int all = -1; // stays negative as long as every index is
    for (const TextureUse* use :
         {&m.base_color_texture, &m.normal_texture, &m.metallic_roughness_texture, &m.emission_texture,
          &m.specular_texture, &m.specular_color_texture, &m.transmission_texture})
        all &= use->texture;
    return all >= 0;
}

glm::vec4 look_up(const Scene& scene, const Mesh& mesh, const Corners& corners, const TextureUse& use) {
    return use.texture < 0 ? glm::vec4(1.0f) : filter(locate(scene, use, Texcoords(mesh, corners).uv));
}

struct MaterialFootprints {
    MaterialFootprints(const Scene& scene, const Mesh& mesh, const Material& m, const Corners& k) {
        if (!is_textured(m)) return;
        const Texcoords t(mesh, k);
        base_color = locate(scene, m.base_color_texture, t.uv);
        normal = locate(scene, m.normal_texture, t.uv);
        metallic_roughness = locate(scene, m.metallic_roughness_texture, t.uv);
        emission = locate(scene, m.emission_texture, t.uv);
        specular = locate(scene, m.specular_texture, t.uv);
        specular_color = locate(scene, m.specular_color_texture, t.uv);
        transmission = locate(scene, m.transmission_texture, t.uv);
    }
    Footprint base_color, normal, metallic_roughness, emission, specular, specular_color, transmission;
};

template <class T> void prefetch(const std::vector<T>& values, const Corners& k) {
    if (values.empty()) return;
    for (std::uint32_t i : {k.a, k.b, k.c}) __builtin_prefetch(&values[i]);
}

void prefetch_corners(const Mesh& mesh, const Material& material, const Corners& k) {
    prefetch(mesh.positions, k), prefetch(mesh.normals, k), prefetch(mesh.colors, k);
    if (is_textured(material)) prefetch(mesh.texcoords[0], k), prefetch(mesh.tangents, k);
}

// Rows are cross products of the columns: inverse transpose up to a positive factor, also for mirroring
// transforms.
glm::mat3 normal_matrix(const glm::mat4& transform, float& handedness) {
    glm::vec3 x(transform[0]), y(transform[1]), z(transform[2]);
    glm::mat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
    handedness = glm::dot(x, cofactors[0]) < 0.0f ? -1.0f : 1.0f;
    return cofactors * handedness;
}

glm::vec3 shading_normal(const Mesh& mesh, const Material& material, const Instance& instance,
                         const Corners& corners, const Footprint& normal_map, glm::vec3 geometric_normal) {
    float handedness = 1.0f;
    glm::vec3 n = normal_matrix(instance.transform, handedness) * interpolate(mesh.normals, corners);
    float length = glm::length(n);
    if (!(length > 0.0f)) return geometric_normal; // opposite vertex normals that cancel
    n /= length;
    if (!normal_map.texture || mesh.tangents.empty()) return n;

    // Tangent frame as glTF defines it; a mirroring transform turns the bitangent around.
    glm::vec4 tangent = interpolate(mesh.tangents, corners);
    glm::vec3 t = glm::mat3(instance.transform) * glm::vec3(tangent);
    float tangent_length = glm::length(t);
    if (!(tangent_length > 0.0f)) return n;
    t /= tangent_length;
    glm::vec3 b = glm::cross(n, t) * (tangent.w < 0.0f ? -handedness : handedness);
    glm::vec3 m = glm::vec3(filter(normal_map)) * 2.0f - 1.0f;
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
void shade(Surface& s, const Mesh& mesh, const Material& material, const MaterialFootprints& textures,
           const Corners& corners) {
    s.base_color = glm::vec3(material.base_color);
    if (textures.base_color.texture) s.base_color *= glm::vec3(filter(textures.base_color));
    if (!mesh.colors.empty()) s.base_color *= glm::vec3(interpolate(mesh.colors, corners));
    s.metallic = material.metallic, s.roughness = material.roughness;
    if (textures.metallic_roughness.texture) {
        glm::vec4 t = filter(textures.metallic_roughness);
        s.roughness *= t.g, s.metallic *= t.b;
    }
    s.transmission = material.transmission * (1.0f - s.metallic);
    if (textures.transmission.texture) s.transmission *= filter(textures.transmission).r;
    s.specular = material.specular;
    if (textures.specular.texture) s.specular *= filter(textures.specular).a;
    s.specular_color = material.specular_color;
    if (textures.specular_color.texture) s.specular_color *= glm::vec3(filter(textures.specular_color));
    s.emission = material.emission;
    if (textures.emission.texture) s.emission *= glm::vec3(filter(textures.emission));
    shared::Brdf brdf =
        shared::make_brdf(s.base_color, s.metallic, s.roughness, material.ior, s.specular, s.specular_color);
    s.brdf = shared::scale_brdf(brdf, 1.0f - s.transmission);
}

} // namespace

glm::vec4 sample_texture(const Texture& texture, glm::vec2 uv) { return filter(footprint(texture, uv)); }

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

void prefetch_indices(const Scene& scene, const Hit& hit) {
    const Mesh& mesh = scene.meshes[std::size_t(scene.instances[hit.instance].mesh)];
    __builtin_prefetch(&mesh.indices[std::size_t(hit.triangle) * 3]);
}

void prefetch_vertices(const Scene& scene, const Hit& hit) {
    const Mesh& mesh = scene.meshes[std::size_t(scene.instances[hit.instance].mesh)];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    prefetch_corners(mesh, material, corners_of(mesh, hit.triangle, {hit.u, hit.v}));
}

void prefetch_texels(const Scene& scene, const Hit& hit) {
    const Mesh& mesh = scene.meshes[std::size_t(scene.instances[hit.instance].mesh)];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    MaterialFootprints(scene, mesh, material, corners_of(mesh, hit.triangle, {hit.u, hit.v}));
}

Surface surface_at(const Scene& scene, const Hit& hit, glm::vec3 direction) {
    const Instance& instance = scene.instances[hit.instance];
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    Corners corners = corners_of(mesh, hit.triangle, {hit.u, hit.v});
    MaterialFootprints textures(scene, mesh, material, corners);

    Surface s;
    s.material = &material;
    place(s, mesh, instance.transform, hit, corners);
    s.front = glm::dot(s.geometric_normal, direction) < 0.0f;

    // Bend on the side that the ray sees, then turn back.
    float side = s.front ? 1.0f : -1.0f;
    glm::vec3 n = shading_normal(mesh, material, instance, corners, textures.normal, s.geometric_normal);
    s.normal = shared::facing_normal(n * side, s.geometric_normal * side, -glm::normalize(direction)) * side;
    shade(s, mesh, material, textures, corners);
    return s;
}

} // namespace luxel
