// SPDX-License-Identifier: MIT
#include "scene/emission_mean.h"

#include <algorithm>
#include <optional>

namespace luxel {
namespace {

using Value = std::function<glm::dvec3(glm::dvec2)>;
using Block = TexelPatches::Block;

// Blocks that one triangle may ask for; what is left then is integrated as if it were smooth.
constexpr int most_visits = 1 << 22;
constexpr float no_cutoff = std::numeric_limits<float>::infinity();

std::array<glm::vec2, 3> coordinates(const Mesh& mesh, std::uint32_t triangle, const TextureUse& use) {
    std::array<glm::vec2, 3> uv;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::vector<glm::vec2>& all = mesh.texcoords[use.set];
        const glm::vec2 stored =
            all.empty() ? glm::vec2(0.0f) : all[mesh.indices[std::size_t(triangle) * 3 + i]];
        uv[i] = glm::vec2(use.transform * glm::vec3(stored, 1.0f));
    }
    return uv;
}

// A triangle's alpha: a factor that is linear over it, times a texture.
struct Alpha {
    bool blended; // it is the share that meets the surface; else the cutoff decides
    double cutoff;
    glm::dvec3 factors; // at the vertices
    const TexelPatches* patches = nullptr;
    bool known = false; // blocks know what of them is covered
    PatchMap map{};

    double least() const { return std::min({factors.x, factors.y, factors.z}); }
    double most() const { return std::max({factors.x, factors.y, factors.z}); }
    double factor(glm::dvec2 p) const {
        return factors.x * (1.0 - p.x - p.y) + factors.y * p.x + factors.z * p.y;
    }
};

// Adds up the light of what alpha leaves.
class Coverage {
public:
    explicit Coverage(const Alpha& alpha) : alpha_(alpha) {}

    // constant: color is the same everywhere in the part.
    glm::dvec3 integral(const TrianglePart& part, const Value& color, bool constant) {
        return alpha_.blended ? blended(part, color) : masked(part, color, constant);
    }

private:
    glm::dvec3 blended(const TrianglePart& part, const Value& color) {
        if (!alpha_.patches) return part.integral([&](glm::dvec2 p) { return color(p) * alpha_.factor(p); });
        glm::dvec3 sum(0.0);
        alpha_.patches->walk(alpha_.map, part, [&](const Block& block, const TrianglePart& piece) {
            if (block.most.a == 0.0f) return true;
            if (block.least.a != block.most.a && !block.single && ++visits_ < most_visits) return false;
            sum += piece.integral([&](glm::dvec2 p) { return color(p) * alpha_at(block, p); });
            return true;
        });
        return sum;
    }

    double alpha_at(const Block& block, glm::dvec2 p) const {
        const glm::dvec2 texels = alpha_.map(p);
        const glm::ivec2 corner = block.single ? block.corner : glm::ivec2(glm::floor(texels));
        return alpha_.factor(p) * alpha_.patches->value(corner, texels).a;
    }

    glm::dvec3 masked(const TrianglePart& part, const Value& color, bool constant) {
        if (!alpha_.patches)
            return covered_integral(
                part, [&](glm::dvec2 p) { return alpha_.factor(p); }, alpha_.cutoff, color);
        glm::dvec3 sum(0.0);
        alpha_.patches->walk(alpha_.map, part, [&](const Block& block, const TrianglePart& piece) {
            if (double(block.most.a) * alpha_.most() < alpha_.cutoff) return true;
            if (double(block.least.a) * alpha_.least() >= alpha_.cutoff) {
                sum += piece.integral(color);
                return true;
            }
            if (block.filled && constant && alpha_.known) {
                sum += color(piece.at[0]) * (block.covered / alpha_.map.density());
                return true;
            }
            if (!block.single && ++visits_ < most_visits) return false;
            sum += covered_integral(
                piece, [&](glm::dvec2 p) { return alpha_at(block, p); }, alpha_.cutoff, color);
            return true;
        });
        return sum;
    }

    const Alpha& alpha_;
    int visits_ = 0;
};

} // namespace

const TexelPatches& EmissionMeans::patches(int texture, float cutoff) {
    const auto key = std::pair(texture, cutoff);
    const auto found = patches_.find(key);
    if (found != patches_.end()) return found->second;
    return patches_.emplace(key, TexelPatches(scene_->textures[std::size_t(texture)], cutoff)).first->second;
}

glm::vec3 EmissionMeans::mean(std::uint32_t instance, std::uint32_t triangle) {
    const Mesh& mesh = scene_->meshes[std::size_t(scene_->instances[instance].mesh)];
    const Material& material = scene_->materials[std::size_t(mesh.material)];
    const TrianglePart whole = TrianglePart::whole();

    std::optional<Alpha> alpha;
    if (material.alpha_mode != AlphaMode::opaque) {
        const float cutoff = material.alpha_cutoff;
        alpha = Alpha{.blended = material.alpha_mode == AlphaMode::blend,
                      .cutoff = double(cutoff),
                      .factors = glm::dvec3(double(material.base_color.a))};
        for (int i = 0; i < 3 && !mesh.colors.empty(); ++i)
            alpha->factors[i] *=
                double(mesh.colors[mesh.indices[std::size_t(triangle) * 3 + std::size_t(i)]].a);
        if (const TextureUse& use = material.base_color_texture; use.texture >= 0) {
            // Which share of a texture is covered is known beforehand where vertices have no say in it.
            const float factor = material.base_color.a;
            alpha->known = !alpha->blended && alpha->factors == glm::dvec3(double(factor)) && factor > 0.0f;
            alpha->patches = &patches(use.texture, alpha->known ? cutoff / factor : no_cutoff);
            alpha->map = alpha->patches->map(coordinates(mesh, triangle, use));
        }
    }

    const TextureUse& use = material.emission_texture;
    if (use.texture < 0) {
        const Value one = [](glm::dvec2) { return glm::dvec3(1.0); };
        const glm::dvec3 share = alpha ? Coverage(*alpha).integral(whole, one, true) : glm::dvec3(0.5);
        return material.emission * glm::vec3(share / whole.area());
    }

    const TexelPatches& texels = patches(use.texture, no_cutoff);
    const PatchMap map = texels.map(coordinates(mesh, triangle, use));
    glm::dvec3 sum(0.0);
    int visits = 0;
    std::optional<Coverage> coverage;
    if (alpha) coverage.emplace(*alpha);
    texels.walk(map, whole, [&](const Block& block, const TrianglePart& part) {
        if (glm::vec3(block.most) == glm::vec3(0.0f)) return true;
        if (!coverage && block.filled) {
            sum += block.color / map.density();
            return true;
        }
        const bool constant = glm::vec3(block.least) == glm::vec3(block.most);
        if (!constant && !block.single && ++visits < most_visits) return false;
        const Value color = [&](glm::dvec2 p) {
            if (constant) return glm::dvec3(block.least);
            const glm::dvec2 at = map(p);
            return glm::dvec3(texels.value(block.single ? block.corner : glm::ivec2(glm::floor(at)), at));
        };
        sum += coverage ? coverage->integral(part, color, constant) : part.integral(color);
        return true;
    });
    return material.emission * glm::vec3(sum / whole.area());
}

} // namespace luxel
