// SPDX-License-Identifier: MIT
// Exact integrals of textures over triangles. Between texels a lookup is bilinear, or constant, so a triangle
// that is cut along the lines where the formula changes is integrated without an error.
#pragma once
#include <array>
#include <functional>
#include <limits>
#include <vector>

#include "scene/scene.h"

namespace luxel {

// A convex part of a triangle, in barycentric coordinates (the weights of its vertices 1 and 2).
struct TrianglePart {
    std::array<glm::dvec2, 48> at;
    std::size_t count = 0;

    static TrianglePart of(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c);
    static TrianglePart whole() { return of({0, 0}, {1, 0}, {0, 1}); }
    double area() const; // .5 for the whole triangle
    // The parts where line.x p.x + line.y p.y + line.z is negative, and where it is not. No point is in both.
    void split(glm::dvec3 line, TrianglePart& below, TrianglePart& above) const;
    // Exact for polynomials up to degree 5 [Radon1948].
    glm::dvec3 integral(const std::function<glm::dvec3(glm::dvec2)>& value) const;
};

// Where a triangle lies on a texture: barycentric coordinates to texels.
struct PatchMap {
    glm::dvec2 origin, u, v;
    glm::dvec2 operator()(glm::dvec2 p) const { return origin + u * p.x + v * p.y; }
    double density() const { return std::abs(u.x * v.y - u.y * v.x); } // texels per barycentric area
};

// The lookups of one texture as unit patches of one formula each, and a tree over them.
class TexelPatches {
public:
    // cutoff: of the alpha channel, for Block::covered.
    explicit TexelPatches(const Texture& texture, float cutoff = std::numeric_limits<float>::infinity());

    PatchMap map(const std::array<glm::vec2, 3>& texture_coordinates) const;

    struct Block {
        glm::vec4 least, most; // bounds of the lookup
        bool filled;           // the part fills the block; color and covered are its integrals in texels
        glm::dvec3 color;
        double covered; // area where alpha reaches the cutoff
        bool single;    // one patch, which begins at `corner`
        glm::ivec2 corner;
    };
    // Walks over blocks and what of `part` lies in each. Where a visit returns false, it goes on to the
    // blocks within; single ones have none.
    using Visit = std::function<bool(const Block&, const TrianglePart&)>;
    void walk(const PatchMap& map, const TrianglePart& part, const Visit& visit) const;

    // The formula of one patch.
    glm::dvec4 value(glm::ivec2 corner, glm::dvec2 texels) const;

private:
    struct Node {
        glm::vec4 least, most;
        glm::dvec3 color{0.0};
        double covered = 0.0;
        int children = -1; // the first of two
    };
    struct Range { // of patches in one period
        glm::ivec2 first, end;
        glm::ivec2 size() const { return end - first; }
        int axis() const { return size().x >= size().y ? 0 : 1; } // along which it is halved
        int middle() const { return (first[axis()] + end[axis()]) / 2; }
        Range half(int which) const;
    };
    struct Walk; // one walk's arguments
    void build(std::size_t node, const Range& range);
    Node summary(const Range& range) const;
    void walk_tiles(const Walk& walk, const TrianglePart& part, const Range& tiles) const;
    void walk_range(const Walk& walk, const TrianglePart& part, glm::ivec2 tile, int node,
                    const Range& range) const;
    Block block(const Walk& walk, const TrianglePart& part, glm::ivec2 tile, const Node& node,
                const Range& range) const;
    glm::vec4 texel_at(glm::ivec2 at) const; // anywhere, wrapped

    const Texture* texture_;
    float cutoff_;
    Range all_; // of a clamped axis all that there are, the outermost without an end
    bool periodic_[2];
    std::vector<Node> nodes_;
};

// The area of a part where alpha, given at any point, reaches the cutoff, and the integral of color there.
// Alpha is smooth within the part.
glm::dvec3 covered_integral(const TrianglePart& part, const std::function<double(glm::dvec2)>& alpha,
                            double cutoff, const std::function<glm::dvec3(glm::dvec2)>& color);

} // namespace luxel
