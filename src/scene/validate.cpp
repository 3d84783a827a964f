// SPDX-License-Identifier: MIT
#include "scene/validate.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace luxel {
namespace {

bool finite(float v) { return std::isfinite(v); }
template <int N> bool finite(const glm::vec<N, float>& v) {
    for (int i = 0; i < N; ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}
template <int N> bool all_finite(const std::vector<glm::vec<N, float>>& values) {
    return std::all_of(values.begin(), values.end(), [](const auto& v) { return finite(v); });
}
bool within(float v, float least, float most) { return v >= least && v <= most; } // false for NaN
bool within(const glm::vec3& v, float least, float most) {
    return within(v.x, least, most) && within(v.y, least, most) && within(v.z, least, most);
}
bool is_unit(const glm::vec3& v) { return within(glm::length(v), 0.999f, 1.001f); }

constexpr float largest = std::numeric_limits<float>::max();

// Sentences with the scene's source and the present object in front.
class Checker {
public:
    Checker(const Scene& scene, const std::string& source) : scene_(scene), source_(source) {}

    void run() {
        each("texture", scene_.textures, [this](const Texture& t) { check(t); });
        each("material", scene_.materials, [this](const Material& m) { check(m); });
        each("mesh", scene_.meshes, [this](const Mesh& m) { check(m); });
        if (scene_.meshes.empty() || scene_.instances.empty())
            fail(Fault::bad_input, "{}: the scene has no triangles", source_);
        each("instance", scene_.instances, [this](const Instance& i) { check(i); });
        each("light", scene_.lights, [this](const shared::Light& l) { check(l); });
        each("camera", scene_.cameras, [this](const Camera& c) { check(c); });
        place_ = "environment";
        check(scene_.environment);
    }

private:
    template <class T, class Check>
    void each(const char* kind, const std::vector<T>& all, Check&& check_one) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            place_ = fmt::format("{} {}", kind, i);
            check_one(all[i]);
        }
    }

    void require(bool condition, const char* reason) const {
        if (!condition) fail(Fault::bad_input, "{}: {}: {}", source_, place_, reason);
    }
    template <class T> void require_index(int index, const std::vector<T>& all, const char* reason) const {
        require(index >= 0 && std::size_t(index) < all.size(), reason);
    }

    void check(const Texture& t) const {
        const Pixels& p = t.pixels;
        require(p.width > 0 && p.height > 0 && p.width <= max_image_side && p.height <= max_image_side,
                "its size is out of range");
        const std::size_t components = std::size_t(p.width) * std::size_t(p.height) * 4;
        require(p.rgba.size() == (p.is_wide() ? 0 : components) &&
                    p.wide.size() == (p.is_wide() ? components : 0),
                "its pixels do not fill its size");
    }

    void check(const TextureUse& use) const {
        if (use.texture < 0) return;
        require_index(use.texture, scene_.textures, "it uses a texture that does not exist");
        require(use.set == 0 || use.set == 1, "it uses a texture coordinate set that does not exist");
        require(finite(use.transform[0]) && finite(use.transform[1]) && finite(use.transform[2]),
                "a texture transform is not finite");
    }

    void check(const Material& m) const {
        require(within(glm::vec3(m.base_color), 0, 1) && within(m.base_color.a, 0, 1),
                "its color is not in [0, 1]");
        require(within(m.metallic, 0, 1) && within(m.roughness, 0, 1),
                "metallic or roughness is not in [0, 1]");
        require(within(m.emission, 0, largest), "its emission is negative or not finite");
        require(finite(m.normal_scale), "its normal scale is not finite");
        require(within(m.ior, 1, largest), "its index of refraction is below 1 or not finite");
        require(within(m.specular, 0, 1) && within(m.specular_color, 0, largest),
                "its specular weight is out of range");
        require(within(m.transmission, 0, 1), "its transmission is not in [0, 1]");
        require(within(m.alpha_cutoff, 0, largest), "its alpha cutoff is negative or not finite");
        for (const TextureUse* use :
             {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.emission_texture,
              &m.specular_texture, &m.specular_color_texture, &m.transmission_texture, &m.height_texture})
            check(*use);
        require(within(m.height_scale, 0, largest), "the depth of its relief is negative or not finite");
        if (!m.has_relief()) return;
        const Texture& heights = scene_.textures[std::size_t(m.height_texture.texture)];
        require(heights.wrap_u == Wrap::repeat && heights.wrap_v == Wrap::repeat && !heights.nearest &&
                    !heights.srgb,
                "its height map is not linear, interpolated and repeating");
    }

    void check(const Mesh& m) {
        const std::size_t vertices = m.positions.size();
        const auto fits = [vertices](const auto& values) {
            return values.empty() || values.size() == vertices;
        };
        require(!m.indices.empty() && m.indices.size() % 3 == 0, "it has no triangles, or parts of one");
        require(*std::max_element(m.indices.begin(), m.indices.end()) < vertices, "an index is out of range");
        require(m.normals.size() == vertices && fits(m.tangents) && fits(m.texcoords[0]) &&
                    fits(m.texcoords[1]) && fits(m.colors),
                "its vertex attributes differ in length");
        require(all_finite(m.positions) && all_finite(m.texcoords[0]) && all_finite(m.texcoords[1]) &&
                    all_finite(m.colors),
                "a vertex is not finite");
        require(std::all_of(m.normals.begin(), m.normals.end(), is_unit), "a normal is not of unit length");
        require(std::all_of(m.tangents.begin(), m.tangents.end(),
                            [](const glm::vec4& t) { return is_unit(t) && (t.w == 1.0f || t.w == -1.0f); }),
                "a tangent is not of unit length");
        require_index(m.material, scene_.materials, "its material does not exist");
        require(!m.tangents.empty() || scene_.materials[std::size_t(m.material)].normal_texture.texture < 0,
                "it has no tangents for its normal texture");
        const Material& material = scene_.materials[std::size_t(m.material)];
        require(!material.has_relief() || !m.texcoords[material.height_texture.set].empty(),
                "it has no texture coordinates for its height map");
        Bounds& box = bounds_.emplace_back();
        for (const glm::vec3& p : m.positions) box.add(p);
    }

    void check(const Instance& i) {
        place_ += i.name.empty() ? "" : fmt::format(" \"{}\"", i.name);
        require_index(i.mesh, scene_.meshes, "its mesh does not exist");
        for (int c = 0; c < 4; ++c) require(finite(i.transform[c]), "its transform is not finite");
        require(i.transform[0][3] == 0 && i.transform[1][3] == 0 && i.transform[2][3] == 0 &&
                    i.transform[3][3] == 1,
                "its transform is not affine");
        const double determinant = glm::determinant(glm::dmat3(i.transform));
        require(std::isfinite(determinant) && determinant != 0.0, "its transform is singular");

        // The corners of the object's box bound what an affine transform makes of its vertices.
        const Bounds& box = bounds_[std::size_t(i.mesh)];
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 p(corner & 1 ? box.most.x : box.least.x, corner & 2 ? box.most.y : box.least.y,
                              corner & 4 ? box.most.z : box.least.z);
            require(within(glm::vec3(i.transform * glm::vec4(p, 1.0f)), -max_coordinate, max_coordinate),
                    "it reaches too far away");
        }
    }

    void check(const shared::Light& l) const {
        require(l.type <= shared::LIGHT_COSINE, "its type is unknown");
        require(finite(l.position), "its position is not finite");
        require(l.type == shared::LIGHT_POINT || is_unit(l.direction), "its direction is not of unit length");
        require(within(l.intensity, 0, largest), "its intensity is negative or not finite");
        require(within(l.range, 0, largest), "its range is negative or not finite");
        require(l.type != shared::LIGHT_SPOT ||
                    (within(l.outer, 0, 2) && within(l.inner, 0, l.outer)),
                "its cone angles are out of order");
    }

    void check(const Camera& c) const {
        require(finite(c.position), "its position is not finite");
        require(is_unit(c.forward) && is_unit(c.up), "its axes are not of unit length");
        require(glm::length(glm::cross(c.forward, c.up)) > 1e-4f, "it looks along its up direction");
        require(c.yfov > 0.0f && c.yfov < 3.1415926f, "its field of view is not within 0 and 180 degrees");
        require(finite(c.half_height) && c.half_height >= 0.0f, "its height is negative or not finite");
        require((c.near > 0.0f || (c.orthographic() && c.near == 0.0f)) && c.far > c.near,
                "its near and far distances are out of order");
    }

    void check(const Environment& e) const {
        require(finite(e.rotation) && within(e.scale, 0, largest), "its rotation or scale is out of range");
        if (e.radiance.empty()) return;
        require(e.radiance.channels == 3 && e.radiance.data.size() == e.radiance.pixels() * 3,
                "it is no color image");
        require(std::all_of(e.radiance.data.begin(), e.radiance.data.end(),
                            [](float v) { return within(v, 0, largest); }),
                "a texel is negative or not finite");
    }

    const Scene& scene_;
    const std::string& source_;
    std::string place_;
    std::vector<Bounds> bounds_; // of each mesh, in object space
};

} // namespace

void validate_scene(const Scene& scene, const std::string& source) { Checker(scene, source).run(); }

} // namespace luxel
