// SPDX-License-Identifier: MIT
#include "reference/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.h"
#include "shared/glsl.h"

namespace luxel {
namespace {

using shared::PI;

constexpr int bins = 12;
constexpr std::ptrdiff_t many = 4096; // of so many emitters, only their longest axis is tried
constexpr int deepest = 60; // beyond it ranges are halved, so that a trail has room for 2^32 emitters

float sine(float cosine) { return std::sqrt(std::max(1.0f - cosine * cosine, 0.0f)); }

// Cosine of the first angle less the second, of 0 where that is larger.
float cos_of_difference(float cos_a, float cos_b) {
    return cos_a >= cos_b ? 1.0f : cos_a * cos_b + sine(cos_a) * sine(cos_b);
}

struct Cone {
    glm::vec3 axis;
    float cos_spread;
};

Cone united(const Cone& a, const Cone& b) {
    const float angle_a = std::acos(glm::clamp(a.cos_spread, -1.0f, 1.0f)),
                angle_b = std::acos(glm::clamp(b.cos_spread, -1.0f, 1.0f)),
                between = std::acos(glm::clamp(glm::dot(a.axis, b.axis), -1.0f, 1.0f));
    if (std::min(between + angle_b, PI) <= angle_a) return a;
    if (std::min(between + angle_a, PI) <= angle_b) return b;
    const float spread = 0.5f * (angle_a + between + angle_b),
                wider = std::min(spread + 1e-3f, PI); // than rounding
    const glm::vec3 aside = b.axis - a.axis * glm::dot(a.axis, b.axis);
    const float length = glm::length(aside);
    if (spread >= PI) return {a.axis, -1.0f};
    if (length < 1e-6f) return {a.axis, between < 1.0f ? std::cos(wider) : -1.0f};
    const float turn = spread - angle_a;
    return {glm::normalize(a.axis * std::cos(turn) + aside * (std::sin(turn) / length)), std::cos(wider)};
}

// The emitters of a part of the tree together; empty at first.
struct Sum {
    EmitterBounds of{{}, {0, 1, 0}, 1.0f, 0.0f, false};
    int count = 0;
    void add(const EmitterBounds& e) {
        const Cone cone = count++ > 0 ? united({of.axis, of.cos_spread}, {e.axis, e.cos_spread})
                                      : Cone{e.axis, e.cos_spread};
        of.axis = cone.axis, of.cos_spread = cone.cos_spread;
        of.box.add(e.box.least), of.box.add(e.box.most);
        of.power += e.power, of.two_sided |= e.two_sided;
    }
    void add(const Sum& s) {
        if (s.count == 0) return;
        const int before = count;
        add(s.of);
        count = before + s.count;
    }
    // Power x solid angle of what they light x area of their box [Conty2018, section 4.4].
    float cost() const {
        if (count == 0) return 0.0f;
        const glm::vec3 e = of.box.most - of.box.least;
        const float area = 2.0f * (e.x * e.y + e.y * e.z + e.z * e.x), length = glm::length(e);
        const float spread = std::acos(glm::clamp(of.cos_spread, -1.0f, 1.0f)),
                    whole = std::min(spread + 0.5f * PI, PI), s = std::sin(spread);
        float angle =
            2.0f * PI * (1.0f - std::cos(spread)) +
            0.5f * PI *
                (2.0f * whole * s - std::cos(spread - 2.0f * whole) - 2.0f * spread * s + std::cos(spread));
        if (of.two_sided) angle *= 2.0f;
        return of.power * angle * (area + 1e-3f * length * length); // flat boxes in a row have no area
    }
};

} // namespace

float importance(const EmitterBounds& b, glm::vec3 position, glm::vec3 normal) {
    const glm::vec3 d = b.box.center() - position;
    const float radius = b.box.radius(), d2 = glm::dot(d, d), nearest2 = std::max(d2, radius * radius);
    if (!(nearest2 > 0.0f)) return b.power;
    if (d2 <= radius * radius) return b.power / nearest2; // within their sphere they may be anywhere

    // The least angles that any of them may have at either end.
    const float distance = std::sqrt(d2), cos_box = sine(radius / distance);
    const glm::vec3 to = d / distance;
    float cosine = -glm::dot(b.axis, to);
    if (b.two_sided) cosine = std::abs(cosine);
    const float emitted = cos_of_difference(cos_of_difference(cosine, b.cos_spread), cos_box);
    if (emitted <= 0.0f) return 0.0f;
    float received = 1.0f;
    if (normal != glm::vec3(0.0f)) received = cos_of_difference(glm::dot(normal, to), cos_box);
    return received > 0.0f ? b.power * emitted * received / nearest2 : 0.0f;
}

LightTree::LightTree(const std::vector<EmitterBounds>& emitters) : trails_(emitters.size()) {
    if (emitters.empty()) return;
    std::vector<std::uint32_t> order(emitters.size());
    std::iota(order.begin(), order.end(), 0u);
    nodes_.reserve(2 * emitters.size());
    build(emitters, order.data(), order.data() + order.size(), 0, 0);
}

std::uint32_t LightTree::build(const std::vector<EmitterBounds>& emitters, std::uint32_t* first,
                               std::uint32_t* end, std::uint64_t trail, int depth) {
    const std::uint32_t index = std::uint32_t(nodes_.size());
    nodes_.emplace_back();
    Sum all;
    Bounds centers;
    for (const std::uint32_t* i = first; i < end; ++i)
        all.add(emitters[*i]), centers.add(emitters[*i].box.center());
    nodes_[index].of = all.of;
    if (end - first == 1) {
        nodes_[index].emitter = *first;
        trails_[*first] = trail;
        return index;
    }

    // The cheapest border between bins of any axis; axes along which the box is short cost more.
    const glm::vec3 extent = centers.most - centers.least;
    const float longest = std::max(std::max(extent.x, extent.y), extent.z);
    float least = std::numeric_limits<float>::max();
    int best_axis = -1, best_bin = 0;
    const auto bin_of = [&](std::uint32_t i, int axis) {
        const float t = (emitters[i].box.center()[axis] - centers.least[axis]) / extent[axis];
        return std::clamp(int(t * bins), 0, bins - 1);
    };
    for (int axis = 0; axis < 3 && depth < deepest / 2; ++axis) {
        if (!(extent[axis] > 0.0f) || (end - first > many && extent[axis] < longest)) continue;
        std::array<Sum, bins> sums;
        for (const std::uint32_t* i = first; i < end; ++i)
            sums[std::size_t(bin_of(*i, axis))].add(emitters[*i]);
        std::array<float, bins> above{};
        Sum right;
        for (std::size_t b = bins - 1; b > 0; --b) right.add(sums[b]), above[b - 1] = right.cost();
        Sum left;
        for (std::size_t b = 0; b + 1 < bins; ++b) {
            left.add(sums[b]);
            const float cost = (left.cost() + above[b]) * longest / extent[axis];
            if (left.count == 0 || left.count == end - first || cost >= least) continue;
            least = cost, best_axis = axis, best_bin = int(b);
        }
    }
    std::uint32_t* middle = first + (end - first) / 2;
    if (best_axis >= 0)
        middle =
            std::partition(first, end, [&](std::uint32_t i) { return bin_of(i, best_axis) <= best_bin; });
    LUXEL_ASSERT(depth < 64 && first < middle && middle < end, "depth={} count={}", depth, end - first);
    build(emitters, first, middle, trail, depth + 1);
    nodes_[index].second = build(emitters, middle, end, trail | (std::uint64_t(1) << depth), depth + 1);
    return index;
}

float LightTree::first_share(const Node& node, std::size_t index, glm::vec3 position, glm::vec3 normal,
                             bool& dark) const {
    const float a = importance(nodes_[index + 1].of, position, normal),
                b = importance(nodes_[node.second].of, position, normal);
    dark = !(a + b > 0.0f);
    return dark ? 0.0f : a / (a + b);
}

LightTree::Choice LightTree::choose(glm::vec3 position, glm::vec3 normal, float u) const {
    Choice choice{0, empty() || importance(nodes_[0].of, position, normal) <= 0.0f ? 0.0f : 1.0f};
    std::size_t index = 0;
    while (choice.chance > 0.0f && nodes_[index].second != 0) {
        const Node& node = nodes_[index];
        bool dark;
        const float first = first_share(node, index, position, normal, dark);
        if (dark) return {};
        if (u < first) {
            u = std::min(u / first, 0x1.fffffep-1f);
            choice.chance *= first, index += 1;
        } else {
            u = std::min((u - first) / (1.0f - first), 0x1.fffffep-1f);
            choice.chance *= 1.0f - first, index = node.second;
        }
    }
    choice.emitter = empty() ? 0 : nodes_[index].emitter;
    return choice;
}

float LightTree::chance(std::size_t emitter, glm::vec3 position, glm::vec3 normal) const {
    if (empty() || importance(nodes_[0].of, position, normal) <= 0.0f) return 0.0f;
    float chance = 1.0f;
    std::uint64_t trail = trails_[emitter];
    std::size_t index = 0;
    while (chance > 0.0f && nodes_[index].second != 0) {
        const Node& node = nodes_[index];
        bool dark;
        const float first = first_share(node, index, position, normal, dark);
        if (dark) return 0.0f;
        const bool second = (trail & 1u) != 0;
        trail >>= 1;
        chance *= second ? 1.0f - first : first;
        index = second ? node.second : index + 1;
    }
    return chance;
}

} // namespace luxel
