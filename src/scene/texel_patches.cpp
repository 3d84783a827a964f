// SPDX-License-Identifier: MIT
#include "scene/texel_patches.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "scene/texture_filter.h"

namespace luxel {
namespace {

constexpr int leaf_patches = 64; // that a leaf of the tree sums up

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

int wrapped(int i, int size, Wrap wrap) {
    if (wrap == Wrap::clamp) return std::clamp(i, 0, size - 1);
    const int period = wrap == Wrap::mirror ? 2 * size : size;
    i = (i % period + period) % period;
    return i < size ? i : period - 1 - i;
}

// The share of a line, along which a value changes evenly from a to b, where it reaches the cutoff.
double share_above(double a, double b, double cutoff) {
    if (a > b) std::swap(a, b);
    if (a >= cutoff || b < cutoff) return a >= cutoff ? 1.0 : 0.0;
    return (b - cutoff) / (b - a);
}

} // namespace

TrianglePart TrianglePart::of(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    TrianglePart part;
    part.at[0] = a, part.at[1] = b, part.at[2] = c;
    part.count = 3;
    return part;
}

double TrianglePart::area() const {
    double twice = 0.0;
    for (std::size_t i = 1; i + 1 < count; ++i) twice += cross(at[i] - at[0], at[i + 1] - at[0]);
    return 0.5 * std::abs(twice);
}

void TrianglePart::split(glm::dvec3 line, TrianglePart& below, TrianglePart& above) const {
    std::array<double, 48> side;
    bool any_below = false, any_above = false;
    for (std::size_t i = 0; i < count; ++i) {
        side[i] = line.x * at[i].x + line.y * at[i].y + line.z;
        any_below |= side[i]<0.0, any_above |= side[i]> 0.0;
    }
    below.count = above.count = 0;
    // What lies on the line as a whole belongs to one side only.
    if (!any_below || !any_above) {
        (any_below ? below : above) = *this;
        return;
    }
    LUXEL_ASSERT(count + 2 <= at.size(), "count={}", count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        if (side[i] <= 0.0) below.at[below.count++] = at[i];
        if (side[i] >= 0.0) above.at[above.count++] = at[i];
        if ((side[i] < 0.0) == (side[next] < 0.0) || side[i] == 0.0 || side[next] == 0.0) continue;
        const glm::dvec2 p = at[i] + (at[next] - at[i]) * (side[i] / (side[i] - side[next]));
        below.at[below.count++] = p, above.at[above.count++] = p;
    }
}

glm::dvec3 TrianglePart::integral(const std::function<glm::dvec3(glm::dvec2)>& value) const {
    // The centroid and two orbits of three points.
    const double root = std::sqrt(15.0), near = (6.0 - root) / 21.0, far = (6.0 + root) / 21.0;
    const double near_weight = (155.0 - root) / 1200.0, far_weight = (155.0 + root) / 1200.0;
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const glm::dvec2 &a = at[0], &b = at[i], &c = at[i + 1];
        const double area = 0.5 * std::abs(cross(b - a, c - a));
        if (area == 0.0) continue;
        const glm::dvec2 total = a + b + c;
        const auto orbit = [&](double share) {
            glm::dvec3 values(0.0);
            for (const glm::dvec2& corner : {a, b, c})
                values += value(total * share + corner * (1.0 - 3.0 * share));
            return values;
        };
        sum += area * (0.225 * value(total / 3.0) + near_weight * orbit(near) + far_weight * orbit(far));
    }
    return sum;
}

TexelPatches::Range TexelPatches::Range::half(int which) const {
    Range part = *this;
    (which == 0 ? part.end : part.first)[axis()] = middle();
    return part;
}

TexelPatches::TexelPatches(const Texture& texture, float cutoff) : texture_(&texture), cutoff_(cutoff) {
    // Patch i reaches from texel i to the next. A clamped texture has constant ones before and behind.
    const int sizes[2] = {texture.pixels.width, texture.pixels.height};
    const Wrap wraps[2] = {texture.wrap_u, texture.wrap_v};
    for (int axis = 0; axis < 2; ++axis) {
        periodic_[axis] = wraps[axis] != Wrap::clamp;
        all_.first[axis] = periodic_[axis] || texture.nearest ? 0 : -1;
        all_.end[axis] = sizes[axis] * (wraps[axis] == Wrap::mirror ? 2 : 1);
    }
    nodes_.emplace_back();
    build(0, all_);
}

PatchMap TexelPatches::map(const std::array<glm::vec2, 3>& texture_coordinates) const {
    const glm::dvec2 size(texture_->pixels.width, texture_->pixels.height);
    std::array<glm::dvec2, 3> p;
    for (std::size_t i = 0; i < 3; ++i)
        p[i] = glm::dvec2(texture_coordinates[i]) * size - (texture_->nearest ? 0.0 : 0.5);
    return {p[0], p[1] - p[0], p[2] - p[0]};
}

glm::vec4 TexelPatches::texel_at(glm::ivec2 at) const {
    const Pixels& pixels = texture_->pixels;
    return texel(*texture_, wrapped(at.x, pixels.width, texture_->wrap_u),
                 wrapped(at.y, pixels.height, texture_->wrap_v));
}

glm::dvec4 TexelPatches::value(glm::ivec2 corner, glm::dvec2 texels) const {
    if (texture_->nearest) return glm::dvec4(texel_at(corner));
    const glm::dvec2 f = glm::clamp(texels - glm::dvec2(corner), 0.0, 1.0);
    const auto at = [&](int x, int y) { return glm::dvec4(texel_at(corner + glm::ivec2(x, y))); };
    return glm::mix(glm::mix(at(0, 0), at(1, 0), f.x), glm::mix(at(0, 1), at(1, 1), f.x), f.y);
}

TexelPatches::Node TexelPatches::summary(const Range& range) const {
    Node node;
    node.least = glm::vec4(std::numeric_limits<float>::max()), node.most = -node.least;
    const int more = texture_->nearest ? 0 : 1;
    for (int y = range.first.y; y < range.end.y; ++y)
        for (int x = range.first.x; x < range.end.x; ++x) {
            glm::dvec4 mean(0.0);
            glm::vec2 alpha(std::numeric_limits<float>::max(), 0.0f);
            for (int i = 0; i < 4; ++i) {
                const glm::vec4 t = texel_at({x + (i & 1) * more, y + (i >> 1) * more});
                node.least = glm::min(node.least, t), node.most = glm::max(node.most, t);
                alpha = {std::min(alpha.x, t.a), std::max(alpha.y, t.a)};
                mean += glm::dvec4(t) * 0.25;
            }
            node.color += glm::dvec3(mean);
            if (alpha.x >= cutoff_) {
                node.covered += 1.0;
            } else if (alpha.y >= cutoff_) {
                // Along a column of the patch alpha is linear: its share is known, and means of many are
                // taken.
                constexpr int columns = 32;
                for (int i = 0; i < columns; ++i) {
                    const double u = (double(i) + 0.5) / double(columns);
                    const double top = value({x, y}, glm::dvec2(double(x) + u, y)).a,
                                 bottom = value({x, y}, glm::dvec2(double(x) + u, y + 1)).a;
                    node.covered += share_above(top, bottom, double(cutoff_)) / double(columns);
                }
            }
        }
    return node;
}

void TexelPatches::build(std::size_t node, const Range& range) {
    if (range.size().x * range.size().y <= leaf_patches) {
        nodes_[node] = summary(range);
        return;
    }
    const std::size_t children = nodes_.size();
    nodes_.resize(children + 2);
    for (int i = 0; i < 2; ++i) build(children + std::size_t(i), range.half(i));
    const Node &a = nodes_[children], &b = nodes_[children + 1];
    nodes_[node] = {glm::min(a.least, b.least), glm::max(a.most, b.most), a.color + b.color,
                    a.covered + b.covered, int(children)};
}

struct TexelPatches::Walk {
    const PatchMap& map;
    const Visit& visit;

    // Both sides of the line where a coordinate of the texture is `border`.
    void split(const TrianglePart& part, int axis, double border, TrianglePart (&halves)[2]) const {
        part.split({map.u[axis], map.v[axis], map.origin[axis] - border}, halves[0], halves[1]);
    }
};

TexelPatches::Block TexelPatches::block(const Walk& walk, const TrianglePart& part, glm::ivec2 tile,
                                        const Node& node, const Range& range) const {
    const glm::ivec2 size = range.size();
    const double area = double(size.x) * double(size.y);
    bool bounded = true;
    for (int axis = 0; axis < 2; ++axis)
        bounded &=
            periodic_[axis] || (range.first[axis] > all_.first[axis] && range.end[axis] < all_.end[axis]);
    const bool filled = bounded && part.area() * walk.map.density() > area * (1.0 - 1e-9);
    return {node.least,
            node.most,
            filled,
            node.color,
            node.covered,
            size.x == 1 && size.y == 1,
            range.first + tile * all_.size()};
}

void TexelPatches::walk_range(const Walk& walk, const TrianglePart& part, glm::ivec2 tile, int node,
                              const Range& range) const {
    if (part.count < 3) return;
    const Node& known = node >= 0 ? nodes_[std::size_t(node)] : summary(range);
    const Block here = block(walk, part, tile, known, range);
    if (walk.visit(here, part) || here.single) return;

    const int axis = range.axis();
    TrianglePart halves[2];
    walk.split(part, axis, double(range.middle()) + double(tile[axis]) * double(all_.size()[axis]), halves);
    for (int i = 0; i < 2; ++i)
        walk_range(walk, halves[i], tile, known.children >= 0 ? known.children + i : -1, range.half(i));
}

void TexelPatches::walk_tiles(const Walk& walk, const TrianglePart& part, const Range& tiles) const {
    if (part.count < 3) return;
    const glm::ivec2 size = tiles.size();
    if (size.x == 1 && size.y == 1) return walk_range(walk, part, tiles.first, 0, all_);

    Node node = nodes_[0];
    const double count = double(size.x) * double(size.y);
    node.color *= count, node.covered *= count;
    const Range range{tiles.first * all_.size(), tiles.end * all_.size()};
    if (walk.visit(block(walk, part, {0, 0}, node, range), part)) return;
    TrianglePart halves[2];
    const int axis = tiles.axis();
    walk.split(part, axis, double(tiles.middle()) * double(all_.size()[axis]), halves);
    for (int i = 0; i < 2; ++i) walk_tiles(walk, halves[i], tiles.half(i));
}

void TexelPatches::walk(const PatchMap& map, const TrianglePart& part, const Visit& visit) const {
    glm::dvec2 least(1e300), most(-1e300);
    for (std::size_t i = 0; i < part.count; ++i)
        least = glm::min(least, map(part.at[i])), most = glm::max(most, map(part.at[i]));
    Range tiles{{0, 0}, {1, 1}};
    for (int axis = 0; axis < 2; ++axis) {
        if (!periodic_[axis]) continue;
        // Coordinates as far out as this have no fraction left in single precision.
        const double period = all_.size()[axis], limit = double(1 << 24);
        const auto tile_of = [&](double x) { return int(std::floor(std::clamp(x, -limit, limit) / period)); };
        tiles.first[axis] = tile_of(least[axis]), tiles.end[axis] = tile_of(most[axis]) + 1;
    }
    walk_tiles({map, visit}, part, tiles);
}

glm::dvec3 covered_integral(const TrianglePart& part, const std::function<double(glm::dvec2)>& alpha,
                            double cutoff, const std::function<glm::dvec3(glm::dvec2)>& color) {
    // In small parts of one patch alpha is nearly a plane.
    constexpr int steps = 8;
    glm::dvec3 sum(0.0);
    const auto add = [&](glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
        const double base = alpha(a), p = alpha(b) - base, q = alpha(c) - base;
        // In the small triangle's own coordinates, then back.
        TrianglePart below, above;
        TrianglePart::whole().split({p, q, base - cutoff}, below, above);
        for (std::size_t i = 0; i < above.count; ++i)
            above.at[i] = a + (b - a) * above.at[i].x + (c - a) * above.at[i].y;
        sum += above.integral(color);
    };
    for (std::size_t k = 1; k + 1 < part.count; ++k) {
        const glm::dvec2 origin = part.at[0], u = (part.at[k] - origin) / double(steps),
                         v = (part.at[k + 1] - origin) / double(steps);
        for (int i = 0; i < steps; ++i)
            for (int j = 0; i + j < steps; ++j) {
                const glm::dvec2 a = origin + u * double(i) + v * double(j);
                add(a, a + u, a + v);
                if (i + j + 1 < steps) add(a + u + v, a + v, a + u);
            }
    }
    return sum;
}

} // namespace luxel
