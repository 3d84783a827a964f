// SPDX-License-Identifier: MIT
#include "scene/surface.h"

#include <algorithm>
#include <cmath>

#include "scene/texture_filter.h"
#include "shared/clearcoat.h"

namespace luxel {
namespace {

// A triangle's values at barycentric weights: from an array of its own, or from the mesh through its indices.
template <class T> T interpolate(const T* values, glm::vec3 weights) {
    return values[0] * weights.x + values[1] * weights.y + values[2] * weights.z;
}
template <class T>
T interpolate(const Mesh& mesh, const std::vector<T>& values, std::uint32_t triangle, glm::vec3 weights) {
    const std::uint32_t* i = &mesh.indices[std::size_t(triangle) * 3];
    return values[i[0]] * weights.x + values[i[1]] * weights.y + values[i[2]] * weights.z;
}

glm::vec3 weights_of(glm::vec2 uv) { return {1.0f - uv.x - uv.y, uv.x, uv.y}; }

// Less than a step of 8 bits from nothing or from all is that.
float coverage_of(float alpha) {
    constexpr float rounding = 1.0f / 512.0f;
    return alpha < rounding ? 0.0f : alpha > 1.0f - rounding ? 1.0f : alpha;
}

float largest_component(glm::vec3 v) { return std::max(std::max(v.x, v.y), v.z); }

// The hit's triangle, from the ray caster's copy where there is one.
struct Corners {
    Corners(const Scene& s, const Hit& h) : scene(s), hit(h), weights(weights_of({h.u, h.v})) {
        if (!h.shading) local = shading_triangle(s, h.instance, h.triangle);
    }
    const ShadingTriangle& triangle() const {
        return hit.shading ? hit.shading->triangles[hit.triangle] : local;
    }
    ShadingTangents tangents() const {
        return hit.shading ? hit.shading->tangents[hit.triangle]
                           : shading_tangents(scene, hit.instance, hit.triangle);
    }
    const Scene& scene;
    const Hit& hit;
    glm::vec3 weights;
    ShadingTriangle local;
};

// What a slot reads at a hit whose coordinates of both sets are `uv`.
Footprint locate(const Scene& scene, const TextureUse& use, const glm::vec2 (&uv)[2]) {
    if (use.texture < 0) return {};
    glm::vec2 transformed(use.transform * glm::vec3(uv[use.set], 1.0f));
    return footprint(scene.textures[std::size_t(use.texture)], transformed);
}

// One slot of a triangle that is known by its indices only.
glm::vec4 look_up(const Scene& scene, const Mesh& mesh, std::uint32_t triangle, glm::vec3 weights,
                  const TextureUse& use) {
    if (use.texture < 0) return glm::vec4(1.0f);
    const std::vector<glm::vec2>& texcoords = mesh.texcoords[use.set];
    glm::vec2 at = texcoords.empty() ? glm::vec2(0.0f) : interpolate(mesh, texcoords, triangle, weights);
    return sample_texture(scene.textures[std::size_t(use.texture)],
                          glm::vec2(use.transform * glm::vec3(at, 1.0f)));
}

bool is_textured(const Material& m) {
    int all = -1; // stays negative as long as every index is
    for (const TextureUse* use :
         {&m.base_color_texture, &m.normal_texture, &m.metallic_roughness_texture, &m.emission_texture,
          &m.specular_texture, &m.specular_color_texture, &m.transmission_texture, &m.clearcoat_texture,
          &m.clearcoat_roughness_texture, &m.clearcoat_normal_texture})
        all &= use->texture;
    return all >= 0;
}

// What all slots of the material read at a hit.
struct MaterialFootprints {
    MaterialFootprints(const Mesh& mesh, const Material& m, const Corners& k) {
        if (!is_textured(m)) return;
        glm::vec2 uv[2] = {interpolate(k.triangle().texcoords, k.weights), glm::vec2(0.0f)};
        if (!mesh.texcoords[1].empty())
            uv[1] = interpolate(mesh, mesh.texcoords[1], k.hit.triangle, k.weights);
        base_color = locate(k.scene, m.base_color_texture, uv);
        normal = locate(k.scene, m.normal_texture, uv);
        metallic_roughness = locate(k.scene, m.metallic_roughness_texture, uv);
        emission = locate(k.scene, m.emission_texture, uv);
        specular = locate(k.scene, m.specular_texture, uv);
        specular_color = locate(k.scene, m.specular_color_texture, uv);
        transmission = locate(k.scene, m.transmission_texture, uv);
        if (m.clearcoat <= 0.0f) return;
        clearcoat = locate(k.scene, m.clearcoat_texture, uv);
        clearcoat_roughness = locate(k.scene, m.clearcoat_roughness_texture, uv);
        clearcoat_normal = locate(k.scene, m.clearcoat_normal_texture, uv);
    }
    Footprint base_color, normal, metallic_roughness, emission, specular, specular_color, transmission,
        clearcoat, clearcoat_roughness, clearcoat_normal;
};

glm::vec3 shading_normal(const Mesh& mesh, const Corners& corners, const Footprint& normal_map, float scale,
                         glm::vec3 geometric_normal) {
    glm::vec3 n = interpolate(corners.triangle().normals, corners.weights);
    float length = glm::length(n);
    if (!(length > 0.0f)) return geometric_normal; // opposite vertex normals that cancel
    n /= length;
    if (!normal_map.texture || mesh.tangents.empty()) return n;

    // Tangent frame as glTF defines it.
    glm::vec4 tangent = interpolate(corners.tangents().data(), corners.weights);
    glm::vec3 t(tangent);
    float tangent_length = glm::length(t);
    if (!(tangent_length > 0.0f)) return n;
    t /= tangent_length;
    glm::vec3 b = glm::cross(n, t) * (tangent.w < 0.0f ? -1.0f : 1.0f);
    glm::vec3 m = glm::vec3(filter(normal_map)) * 2.0f - 1.0f;
    glm::vec3 bent = t * (m.x * scale) + b * (m.y * scale) + n * m.z;
    float bent_length = glm::length(bent);
    return bent_length > 0.0f ? bent / bent_length : n;
}

// Position, geometric normal and the clearance that their rounding asks for.
void place(Surface& s, const Corners& corners) {
    const glm::vec3 &a = corners.triangle().positions[0], &b = corners.triangle().positions[1],
                    &c = corners.triangle().positions[2];
    s.offset = clearance(largest_component(glm::max(glm::max(glm::abs(a), glm::abs(b)), glm::abs(c))));
    s.geometric_normal = glm::normalize(corners.hit.geometric_normal);

    // At an edge the same rounding could carry the point past the wall that meets it there: draw it inward by
    // a few clearances.
    float extent = largest_component(glm::max(glm::abs(b - a), glm::abs(c - a)));
    float inward = std::min(4.0f * s.offset / std::max(extent, 1e-30f), 0.1f) / 3.0f;
    s.position = interpolate(corners.triangle().positions, corners.weights * (1.0f - 3.0f * inward) + inward);
}

// Factors times textures.
void look_up_material(Surface& s, const Mesh& mesh, const Material& material,
                      const MaterialFootprints& textures, const Corners& corners) {
    glm::vec4 base = material.base_color;
    if (textures.base_color.texture) base *= filter(textures.base_color);
    if (!mesh.colors.empty()) base *= interpolate(mesh, mesh.colors, corners.hit.triangle, corners.weights);
    s.base_color = glm::vec3(base);
    s.coverage = material.alpha_mode == AlphaMode::blend ? coverage_of(base.a) : 1.0f;
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
}

// The lobes that the factors make, toward a viewer; normals are known. Directions below the geometric horizon
// are left out by whoever samples the diffuse lobe.
shared::Brdf lobes_of(const Surface& s, BrdfModel model, glm::vec3 to_viewer) {
    const float ior = s.material->ior;
    const bool lambertian =
        s.metallic <= 0.0f && s.specular <= 0.0f; // both models are the same, this is faster
    shared::Brdf brdf =
        model == BrdfModel::single || lambertian
            ? shared::make_brdf(s.base_color, s.metallic, s.roughness, ior, s.specular, s.specular_color)
            : shared::make_brdf_toward(std::abs(glm::dot(s.normal, to_viewer)), s.base_color, s.metallic,
                                       s.roughness, ior, s.specular, s.specular_color);
    return shared::scale_brdf(brdf, 1.0f - s.transmission);
}

// Facets of a rough sheet send all to one of its sides, of a solid's they lose what they pass on to each
// other.
float gain_of_glass(const Surface& s, BrdfModel model, glm::vec3 to_viewer) {
    if (model == BrdfModel::single || !s.material->thin || s.transmission <= 0.0f ||
        s.roughness < shared::MIRROR_ROUGHNESS)
        return 1.0f;
    return 1.0f / shared::ggx_directional_albedo(std::abs(glm::dot(s.normal, to_viewer)), s.brdf.alpha).whole;
}

void add_coat(Surface& s, const MaterialFootprints& textures, BrdfModel model, glm::vec3 to_viewer) {
    float share = s.material->clearcoat, roughness = s.material->clearcoat_roughness;
    if (textures.clearcoat.texture) share *= filter(textures.clearcoat).r;
    if (textures.clearcoat_roughness.texture) roughness *= filter(textures.clearcoat_roughness).g;
    const shared::Coat coat =
        shared::make_coat(share, roughness, std::abs(glm::dot(s.coat_normal, to_viewer)),
                          model == BrdfModel::multiple ? 1.0f : 0.0f);
    s.coat = coat.lobe;
    s.brdf = shared::scale_brdf(s.brdf, coat.passes);
    s.glass_gain *= coat.passes;
}

} // namespace

glm::vec4 sample_texture(const Texture& texture, glm::vec2 uv) { return filter(footprint(texture, uv)); }

glm::vec3 emission_at(const Scene& scene, std::uint32_t instance, std::uint32_t triangle, glm::vec2 uv) {
    const Mesh& mesh = scene.meshes[std::size_t(scene.instances[instance].mesh)];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    const float met =
        material.alpha_mode == AlphaMode::blend ? coverage_at(scene, instance, triangle, uv) : 1.0f;
    return material.emission * met *
           glm::vec3(look_up(scene, mesh, triangle, weights_of(uv), material.emission_texture));
}

float coverage_at(const Scene& scene, std::uint32_t instance, std::uint32_t triangle, glm::vec2 uv) {
    const Mesh& mesh = scene.meshes[std::size_t(scene.instances[instance].mesh)];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    if (material.alpha_mode == AlphaMode::opaque) return 1.0f;
    const glm::vec3 weights = weights_of(uv);
    float alpha =
        material.base_color.a * look_up(scene, mesh, triangle, weights, material.base_color_texture).a;
    if (!mesh.colors.empty()) alpha *= interpolate(mesh, mesh.colors, triangle, weights).a;
    if (material.alpha_mode == AlphaMode::blend) return coverage_of(alpha);
    return alpha < material.alpha_cutoff ? 0.0f : 1.0f;
}

bool is_transparent(const Scene& scene, std::uint32_t instance, std::uint32_t triangle, glm::vec2 uv) {
    return coverage_at(scene, instance, triangle, uv) <= 0.0f;
}

void load_triangle(const Hit& hit) {
    if (!hit.shading) return;
    const auto* first = reinterpret_cast<const volatile char*>(&hit.shading->triangles[hit.triangle]);
    static_cast<void>(first[0]), static_cast<void>(first[sizeof(ShadingTriangle) - 1]);
}

void prefetch_texels(const Scene& scene, const Hit& hit) {
    const Mesh& mesh = scene.meshes[std::size_t(scene.instances[hit.instance].mesh)];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    if (!is_textured(material)) return;
    const MaterialFootprints f(mesh, material, Corners(scene, hit));
    for (const Footprint* slot : {&f.base_color, &f.normal, &f.metallic_roughness, &f.emission, &f.specular,
                                  &f.specular_color, &f.transmission})
        prefetch(*slot);
}

Surface surface_at(const Scene& scene, const Hit& hit, glm::vec3 direction) {
    const Mesh& mesh = scene.meshes[std::size_t(scene.instances[hit.instance].mesh)];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    const Corners corners(scene, hit);
    const MaterialFootprints textures(mesh, material, corners);

    Surface s{};
    s.material = &material;
    place(s, corners);
    s.front = glm::dot(s.geometric_normal, direction) < 0.0f;

    look_up_material(s, mesh, material, textures, corners);

    // Bend on the side that the ray sees, then turn back.
    const float side = s.front ? 1.0f : -1.0f;
    const glm::vec3 ng = s.geometric_normal * side, to_viewer = -glm::normalize(direction);
    const auto bent = [&](const Footprint& map, float scale, float specular) {
        const glm::vec3 n = shading_normal(mesh, corners, map, scale, s.geometric_normal);
        return shared::bent_normal(n * side, ng, to_viewer, specular) * side;
    };
    s.normal = bent(textures.normal, material.normal_scale,
                    shared::share_without_diffuse(s.metallic, s.transmission));
    s.brdf = lobes_of(s, scene.brdf, to_viewer);
    s.glass_gain = gain_of_glass(s, scene.brdf, to_viewer);
    s.coat_normal = s.normal;
    if (material.clearcoat > 0.0f) {
        s.coat_normal = bent(textures.clearcoat_normal, material.clearcoat_normal_scale, 1.0f);
        add_coat(s, textures, scene.brdf, to_viewer);
    }
    return s;
}

} // namespace luxel
