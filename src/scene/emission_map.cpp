// SPDX-License-Identifier: MIT
#include "scene/emission_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/surface.h"

namespace luxel {
namespace {

constexpr double most_texels = double(1 << 22); // of one triangle
constexpr double most_blocks = double(1 << 14);

float cross(glm::vec2 a, glm::vec2 b) { return a.x * b.y - a.y * b.x; }

} // namespace

// Convex: a triangle cut by four lines has seven corners at most.
struct EmissionMap::Polygon {
    std::array<glm::vec2, 8> at;
    std::size_t count = 0;

    // What lies on the side of the line { p : p[axis] = border } where sign * p[axis] is larger.
    void cut(int axis, float border, float sign) {
        Polygon kept;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec2 a = at[i], b = at[(i + 1) % count];
            const float da = sign * (a[axis] - border), db = sign * (b[axis] - border);
            if (da >= 0.0f) kept.at[kept.count++] = a;
            if ((da > 0.0f && db < 0.0f) || (da < 0.0f && db > 0.0f)) {
                glm::vec2 p = a + (b - a) * (da / (da - db));
                p[axis] = border;
                kept.at[kept.count++] = p;
            }
        }
        *this = kept;
    }
    float area_of(std::size_t fan) const {
        return 0.5f * std::abs(cross(at[fan + 1] - at[0], at[fan + 2] - at[0]));
    }
    float area() const {
        float sum = 0.0f;
        for (std::size_t i = 0; i + 2 < count; ++i) sum += area_of(i);
        return sum;
    }
};

EmissionMap::Polygon EmissionMap::part(int x, int y, int side) const {
    Polygon p;
    for (const glm::vec2& corner : corners_) p.at[p.count++] = corner;
    p.cut(0, float(x), 1.0f), p.cut(0, float(x + side), -1.0f);
    p.cut(1, float(y), 1.0f), p.cut(1, float(y + side), -1.0f);
    return p;
}

EmissionMap::EmissionMap(const Scene& scene, std::uint32_t instance, std::uint32_t triangle) {
    const Mesh& mesh = scene.meshes[std::size_t(scene.instances[instance].mesh)];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    const TextureUse& use = material.emission_texture;
    if (use.texture < 0 || mesh.texcoords[use.set].empty()) return;
    const Texture& texture = scene.textures[std::size_t(use.texture)];
    const glm::vec2 size(texture.pixels.width, texture.pixels.height);
    glm::vec2 least(1e30f), most(-1e30f);
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec2 uv = mesh.texcoords[use.set][mesh.indices[std::size_t(triangle) * 3 + k]];
        corners_[k] = glm::vec2(use.transform * glm::vec3(uv, 1.0f)) * size - (texture.nearest ? 0.0f : 0.5f);
        least = glm::min(least, corners_[k]), most = glm::max(most, corners_[k]);
    }
    const glm::vec2 extent = most - least;
    area_ = 0.5f * std::abs(cross(corners_[1] - corners_[0], corners_[2] - corners_[0]));
    if (!(area_ > 1e-4f * glm::dot(extent, extent)) || !(area_ > 1e-3f)) return; // a line, or a point
    if (!(double(extent.x + 2.0f) * double(extent.y + 2.0f) < most_texels)) return;
    left_ = int(std::floor(least.x)), top_ = int(std::floor(least.y));
    const int width = int(std::floor(most.x)) - left_ + 1, height = int(std::floor(most.y)) - top_ + 1;

    // Texels at whole numbers; a bilinear patch lies between four of them.
    const int more = texture.nearest ? 0 : 1;
    std::vector<glm::vec3> texels;
    texels.reserve(std::size_t(width + more) * std::size_t(height + more));
    for (int y = 0; y < height + more; ++y)
        for (int x = 0; x < width + more; ++x)
            texels.push_back(
                glm::vec3(sample_texture(texture, (glm::vec2(left_ + x, top_ + y) + 0.5f) / size)));
    const auto texel = [&](int x, int y) {
        return texels[std::size_t(y) * std::size_t(width + more) + std::size_t(x)] * material.emission;
    };

    block_ = std::max(1, int(std::ceil(std::sqrt(double(width) * double(height) / most_blocks))));
    columns_ = (width + block_ - 1) / block_, rows_ = (height + block_ - 1) / block_;
    std::vector<double> weights(std::size_t(columns_) * std::size_t(rows_));
    glm::dvec3 sum(0.0);
    double total = 0.0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Polygon p = part(left_ + x, top_ + y, 1);
            if (p.count < 3) continue;
            const glm::vec3 a = texel(x, y), b = texel(x + more, y), c = texel(x, y + more),
                            d = texel(x + more, y + more);
            const auto value = [&](glm::vec2 at) {
                const glm::vec2 f = glm::clamp(at - glm::vec2(left_ + x, top_ + y), 0.0f, 1.0f);
                return glm::mix(glm::mix(a, b, f.x), glm::mix(c, d, f.x), f.y);
            };
            // Exact for the patch, a polynomial of degree two: means of edge middles of each triangle of a
            // fan.
            float area = 0.0f;
            for (std::size_t i = 0; i + 2 < p.count; ++i) {
                const glm::vec2 &p0 = p.at[0], &p1 = p.at[i + 1], &p2 = p.at[i + 2];
                const glm::vec3 mean =
                    (value(0.5f * (p0 + p1)) + value(0.5f * (p1 + p2)) + value(0.5f * (p2 + p0))) / 3.0f;
                sum += glm::dvec3(mean * p.area_of(i)), area += p.area_of(i);
            }
            const double weight = double(area) * double(luminance(a + b + c + d));
            weights[std::size_t(y / block_) * std::size_t(columns_) + std::size_t(x / block_)] += weight;
            total += weight;
        }
    mean_ = glm::vec3(sum / double(area_));
    double so_far = 0.0;
    for (const double weight : weights)
        cumulative_.push_back(total > 0.0 ? float((so_far += weight) / total) : 0.0f);
}

EmissionMap::Drawn EmissionMap::draw(glm::vec2 u) const {
    const float at = u.x * cumulative_.back();
    const std::size_t i = std::min(
        std::size_t(std::upper_bound(cumulative_.begin(), cumulative_.end(), at) - cumulative_.begin()),
        cumulative_.size() - 1);
    const float before = i > 0 ? cumulative_[i - 1] : 0.0f, share = cumulative_[i] - before;
    if (!(share > 0.0f)) return {glm::vec2(1.0f / 3.0f), 0.0f};
    float rest = std::min((at - before) / share, 0x1.fffffep-1f);

    // A triangle of the block's fan, then uniform in it [Turk1990].
    const Polygon p = part(left_ + int(i % std::size_t(columns_)) * block_,
                           top_ + int(i / std::size_t(columns_)) * block_, block_);
    const float area = p.area();
    if (p.count < 3 || !(area > 0.0f)) return {glm::vec2(1.0f / 3.0f), 0.0f};
    std::size_t fan = 0;
    rest *= area;
    while (fan + 3 < p.count && rest >= p.area_of(fan)) rest -= p.area_of(fan++);
    const float root = std::sqrt(std::clamp(rest / p.area_of(fan), 0.0f, 1.0f));
    const glm::vec2 point =
        p.at[0] * (1.0f - root) + p.at[fan + 1] * (root * (1.0f - u.y)) + p.at[fan + 2] * (root * u.y);

    const glm::vec2 e1 = corners_[1] - corners_[0], e2 = corners_[2] - corners_[0], d = point - corners_[0];
    const float whole = cross(e1, e2);
    glm::vec2 uv = glm::clamp(glm::vec2(cross(d, e2), cross(e1, d)) / whole, 0.0f, 1.0f);
    if (uv.x + uv.y > 1.0f) uv /= uv.x + uv.y;
    return {uv, share * area_ / area};
}

float EmissionMap::density(glm::vec2 uv) const {
    const glm::vec2 point =
        corners_[0] + (corners_[1] - corners_[0]) * uv.x + (corners_[2] - corners_[0]) * uv.y;
    const int x = std::clamp((int(std::floor(point.x)) - left_) / block_, 0, columns_ - 1),
              y = std::clamp((int(std::floor(point.y)) - top_) / block_, 0, rows_ - 1);
    const std::size_t i = std::size_t(y) * std::size_t(columns_) + std::size_t(x);
    const float share = cumulative_[i] - (i > 0 ? cumulative_[i - 1] : 0.0f);
    const float area = part(left_ + x * block_, top_ + y * block_, block_).area();
    return area > 0.0f ? share * area_ / area : 0.0f;
}

} // namespace luxel
