// SPDX-License-Identifier: MIT
// The scene as plain data. World space: meters, right-handed, +y up; radiance in W/(m2 sr) per linear-sRGB
// channel. glTF's photometric units map 1:1 to radiant ones per channel: nit -> W/(m2 sr), candela -> W/sr,
// lux -> W/m2; only ratios matter to an image, and emissive meshes and punctual lights keep theirs.
#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/image.h"
#include "core/image_io.h"
#include "shared/light.h"

namespace luxel {

enum class Wrap { repeat, clamp, mirror };

struct Texture {
    std::string name;
    Pixels pixels;     // as stored
    bool srgb = false; // color data (sRGB curve) or numbers (linear)
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool nearest = false;
};

// A texture as a material uses it. uv' = transform * (u, v, 1).
struct TextureUse {
    int texture = -1; // index into Scene::textures; -1 = none
    int set = 0;      // texcoord set, 0 or 1
    glm::mat3 transform{1.0f};
};

enum class AlphaMode { opaque, mask, blend }; // blend: alpha is the share of the light that meets the surface

struct Material {
    std::string name;
    glm::vec4 base_color{1.0f};
    float metallic = 1.0f, roughness = 1.0f;
    glm::vec3 emission{0.0f}; // radiance; emissiveFactor x emissive_strength
    float normal_scale = 1.0f;
    float ior = 1.5f;
    float specular = 1.0f;
    glm::vec3 specular_color{1.0f};
    float transmission = 0.0f;
    bool thin = true; // no KHR_materials_volume: light passes without refraction
    // Solids (thin = false): white light that went attenuation_distance meters through the inside has the
    // color attenuation_color (Beer's law); infinity absorbs nothing.
    glm::vec3 attenuation_color{1.0f};
    float attenuation_distance = std::numeric_limits<float>::infinity();
    float clearcoat = 0.0f,
          clearcoat_roughness = 0.0f; // KHR_materials_clearcoat: a coat of index 1.5 over it all
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;
    // Single-sided surfaces emit from their front only; to light, both kinds are opaque from behind.
    bool double_sided = false;
    // Cameras look through the backs, as glTF displays single-sided surfaces. Light does not: shadows and
    // bounces meet them. The boundaries of solids stay, as their backs are what an eye inside looks through.
    bool backs_unseen = false;
    bool looks_through_back() const { return backs_unseen && (thin || transmission <= 0.0f); }
    TextureUse base_color_texture, metallic_roughness_texture, normal_texture, emission_texture,
        specular_texture, specular_color_texture, transmission_texture, clearcoat_texture,
        clearcoat_roughness_texture, clearcoat_normal_texture;
    float clearcoat_normal_scale = 1.0f;
    // Relief behind the surface: texels of 1 lie on it, those of 0 height_scale meters behind (world, along
    // the normal). Red channel, repeating. See scene/height_field.h.
    TextureUse height_texture;
    float height_scale = 0.0f;
    bool has_relief() const { return height_texture.texture >= 0 && height_scale > 0.0f; }
};

// One indexed triangle list with one material, in object space. Normals are always present (generated when
// the file has none); tangents (xyz, handedness) are present when the material has a normal texture.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents;     // empty or positions.size()
    std::vector<glm::vec2> texcoords[2]; // each empty or positions.size()
    std::vector<glm::vec4> colors;       // linear, empty or positions.size()
    std::vector<std::uint32_t> indices;  // multiple of 3, every index < positions.size()
    int material = 0;                    // index into Scene::materials
};

// What the camera sees in place of an object's mesh. Everything else, the reference too, keeps the mesh.
enum class ImpostorKind { none, billboard, nailboard, billboard_cloud };
struct Impostor {
    ImpostorKind kind = ImpostorKind::none;
    int size = 256;        // texels along the longest side of the object
    float error = 1.0f;    // billboard, nailboard: pixels that a point may be displaced before it is redrawn
    float distance = 0.0f; // billboard cloud: meters between a vertex and the plane that shows it
    bool operator==(const Impostor&) const = default;
};

// Front faces are those wound counter-clockwise in object space, also under a mirroring transform.
struct Instance {
    std::string name;
    int mesh = 0;
    glm::mat4 transform{1.0f}; // object to world
    std::string role;          // free text from the scene file, "" by default
    Impostor impostor{};
};

struct Camera {
    std::string name;
    glm::vec3 position{0.0f}, forward{0.0f, 0.0f, -1.0f},
        up{0.0f, 1.0f, 0.0f}; // unit, up need not be orthogonal
    float yfov = 0.9f;        // radians, vertical, whole angle
    float near = 0.01f;       // meters
    // Meters along `forward`; geometry beyond it is not seen. Infinite: all is seen.
    float far = std::numeric_limits<float>::infinity();
    float half_height =
        0.0f; // orthographic when > 0: half of the image's height in meters; yfov has no say then
    bool orthographic() const { return half_height > 0.0f; }
};

// Infinitely distant light from an equirectangular map. Direction (0, 1, 0) is the top row; the middle column
// is -z, u grows to the right seen from inside: u = .5 + atan2(x, -z) / (2 pi), v = acos(y) / pi; before
// `rotation`.
struct Environment {
    Image radiance;        // 3 channels, linear; empty = none
    float rotation = 0.0f; // radians about +y, counter-clockwise seen from above
    float scale = 1.0f;
    bool empty() const { return radiance.empty() || scale <= 0.0f; }
};
glm::vec3 evaluate(const Environment& environment, glm::vec3 direction); // nearest texel, times scale

struct Bounds {
    glm::vec3 least{1e30f}, most{-1e30f};
    void add(glm::vec3 p) { least = glm::min(least, p), most = glm::max(most, p); }
    bool empty() const { return least.x > most.x; }
    glm::vec3 center() const { return (least + most) * 0.5f; }
    float radius() const { return empty() ? 0.0f : glm::length(most - least) * 0.5f; }
};

// How lobes keep their energy: with all that facets pass on to each other, or by single scattering, with a
// diffuse albedo that is the same from everywhere (shared/brdf.h).
enum class BrdfModel { multiple, single };

struct Scene {
    std::string name;
    BrdfModel brdf = BrdfModel::multiple;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<shared::Light> lights; // punctual only; emissive meshes are found through materials
    std::vector<Camera> cameras;       // never empty after load_scene
    Environment environment;
    // Where (0, 0, 0) is in the coordinates that the files use. Scenes far from their origin are moved to it,
    // because single precision holds millimeters only for some kilometers.
    glm::dvec3 origin{0.0};
    std::vector<std::string> warnings; // one sentence each; e.g. a missing texture that was substituted

    Bounds bounds() const; // world
    std::size_t triangles() const;
};

// -1 where a transform mirrors, otherwise 1. In double: the product of small scales underflows.
inline float handedness(const glm::mat4& transform) {
    return glm::determinant(glm::dmat3(transform)) < 0.0 ? -1.0f : 1.0f;
}

// A position and a direction basis for pixel rays; the frame uses the same numbers.
// Ray through pixel (x, y) of width x height at sub-pixel offset `jitter` in [0, 1)^2, (.5, .5) = center:
// direction = forward + right * (2 (x + jitter.x) / width - 1) * tan(yfov / 2) * width / height
//                     - up * ... (row 0 on top); not normalized: its component along `forward` is 1.
// An orthographic camera's rays all go forward, from the plane through its position.
struct CameraBasis {
    glm::vec3 position, forward, right, up; // right and up already scaled by the half extents at distance 1
                                            // (perspective) or of the image (orthographic)
    bool orthographic = false;
    // The side of a pixel of an image so many pixels high: at distance t, or everywhere.
    float pixel_side(int height, float t) const {
        return 2.0f * glm::length(up) / float(height) * (orthographic ? 1.0f : t);
    }
};
CameraBasis camera_basis(const Camera& camera, int width, int height);
// From the middle of the image, in half extents.
inline glm::vec3 pixel_offset(const CameraBasis& b, int width, int height, glm::vec2 pixel) {
    return b.right * (2.0f * pixel.x / float(width) - 1.0f) - b.up * (2.0f * pixel.y / float(height) - 1.0f);
}
inline glm::vec3 pixel_direction(const CameraBasis& b, int width, int height, glm::vec2 pixel) {
    return b.orthographic ? b.forward : b.forward + pixel_offset(b, width, height, pixel);
}
inline glm::vec3 pixel_origin(const CameraBasis& b, int width, int height, glm::vec2 pixel) {
    return b.orthographic ? b.position + pixel_offset(b, width, height, pixel) : b.position;
}

} // namespace luxel
