// SPDX-License-Identifier: MIT
// Nearest-texel lookup of equirectangular maps and the sampling distribution that goes with it.
#include "scene/environment.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "scene/environment_layout.h"

namespace luxel {
namespace {

using shared::PI;

glm::vec3 rotate_y(glm::vec3 v, float angle) {
    const float c = std::cos(angle), s = std::sin(angle);
    return {v.x * c + v.z * s, v.y, v.z * c - v.x * s};
}

int texel_index(float coordinate, int size) { return std::clamp(int(coordinate * float(size)), 0, size - 1); }

// Cosines of the polar angles that bound row y.
float row_cosine(int y, int height) { return y == height ? -1.0f : std::cos(PI * float(y) / float(height)); }

// An importance of zero must mean that no light comes from there, whatever the file stores.
float importance(const Environment& environment, int x, int y) {
    return std::max(0.0f, luminance(environment.radiance.rgb(x, y)));
}

// Turns counts into cumulative shares that end at exactly 1; all equal to 0 if there is nothing.
double accumulate(const std::vector<double>& weights, float* shares) {
    double total = 0.0;
    for (const double w : weights) total += w;
    double sum = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += weights[i];
        shares[i] = total > 0.0 ? (sum < total ? float(sum / total) : 1.0f) : 0.0f;
    }
    return total;
}

struct Choice {
    int index;
    float rest; // where within the chosen share, [0, 1)
};

// The first share above u; shares of weight zero repeat their predecessor and are never the first.
Choice choose(const float* shares, int count, float u) {
    const int index = int(std::upper_bound(shares, shares + count, u) - shares);
    LUXEL_ASSERT(index < count, "u={} last={}", u, shares[count - 1]);
    const float below = index > 0 ? shares[index - 1] : 0.0f;
    return {index, std::min((u - below) / (shares[index] - below), 0x1.fffffep-1f)};
}

} // namespace

glm::vec3 environment_direction(const Environment& environment, glm::vec2 uv) {
    const float theta = PI * uv.y, phi = 2.0f * PI * (uv.x - 0.5f);
    const glm::vec3 local(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
    return rotate_y(local, environment.rotation);
}

glm::vec2 environment_uv(const Environment& environment, glm::vec3 direction) {
    const glm::vec3 d = rotate_y(glm::normalize(direction), -environment.rotation);
    return {0.5f + std::atan2(d.x, -d.z) / (2.0f * PI), std::atan2(std::hypot(d.x, d.z), d.y) / PI};
}

glm::vec3 evaluate(const Environment& environment, glm::vec3 direction) {
    if (environment.empty()) return glm::vec3(0.0f);
    const Image& map = environment.radiance;
    const glm::vec2 uv = environment_uv(environment, direction);
    return map.rgb(texel_index(uv.x, map.width), texel_index(uv.y, map.height)) * environment.scale;
}

float texel_solid_angle(const Environment& environment, int y) {
    const Image& map = environment.radiance;
    return 2.0f * PI / float(map.width) * (row_cosine(y, map.height) - row_cosine(y + 1, map.height));
}

EnvironmentSampler::EnvironmentSampler(const Environment& environment) : environment_(&environment) {
    if (environment.empty()) return;
    const Image& map = environment.radiance;
    rows_.resize(std::size_t(map.height));
    columns_.resize(map.pixels());

    // Rows are chosen by their power, then columns by luminance: all texels of a row span the same solid
    // angle.
    std::vector<double> row_power(rows_.size()), weights(std::size_t(map.width));
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) weights[std::size_t(x)] = double(importance(environment, x, y));
        const double total = accumulate(weights, &columns_[std::size_t(y) * weights.size()]);
        row_power[std::size_t(y)] = total * double(texel_solid_angle(environment, y));
    }
    power_ = accumulate(row_power, rows_.data()) * double(environment.scale);
}

EnvironmentSample EnvironmentSampler::sample(glm::vec2 u) const {
    LUXEL_ASSERT(!empty(), "power={}", power_);
    const Image& map = environment_->radiance;
    const Choice row = choose(rows_.data(), map.height, u.y);
    const Choice column = choose(&columns_[std::size_t(row.index) * std::size_t(map.width)], map.width, u.x);

    // Within the texel uniform in solid angle, that is in longitude and in the cosine of the polar angle.
    const float top = row_cosine(row.index, map.height), bottom = row_cosine(row.index + 1, map.height);
    const float theta = std::acos(std::clamp(glm::mix(top, bottom, row.rest), -1.0f, 1.0f));
    EnvironmentSample s;
    s.direction = environment_direction(*environment_,
                                        {(float(column.index) + column.rest) / float(map.width), theta / PI});
    s.radiance = map.rgb(column.index, row.index) * environment_->scale;
    s.pdf = importance(*environment_, column.index, row.index) * environment_->scale / float(power_);
    return s;
}

float EnvironmentSampler::pdf(glm::vec3 direction) const {
    if (empty()) return 0.0f;
    const Image& map = environment_->radiance;
    const glm::vec2 uv = environment_uv(*environment_, direction);
    const int x = texel_index(uv.x, map.width), y = texel_index(uv.y, map.height);
    return importance(*environment_, x, y) * environment_->scale / float(power_);
}

Image environment_map(const Image& picture, const std::string& file, std::vector<std::string>& warnings) {
    // Whatever is twice as wide as high is what it should be; cubes are recognized.
    const MapLayout layout = layout_of(picture);
    const bool unfolded =
        layout != MapLayout::equirectangular && layout != MapLayout::square && layout != MapLayout::other;
    if (unfolded && 4 * std::max(picture.width, picture.height) / 3 > max_image_side)
        fail(Fault::bad_input, "{}: {}x{} pixels are too many for a cube; scale it down", file, picture.width,
             picture.height);
    if (unfolded)
        warnings.push_back(fmt::format("{}: the environment is {}; it is converted to an equirectangular map",
                                       file, describe(layout)));
    else if (layout != MapLayout::equirectangular)
        warnings.push_back(fmt::format("{}: the environment is {} ({}x{}); it is read as an equirectangular "
                                       "map all the same, stretched over the sphere",
                                       file, describe(layout), picture.width, picture.height));
    const Image stored = unfolded ? equirectangular(picture, layout) : picture;

    Image map(stored.width, stored.height, 3);
    std::size_t negative = 0;
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const glm::vec3 color = stored.rgb(x, y);
            if (color.r < 0.0f || color.g < 0.0f || color.b < 0.0f) ++negative;
            map.set_rgb(x, y, glm::max(color, glm::vec3(0.0f)));
        }
    if (negative > 0)
        warnings.push_back(fmt::format("{}: {} texels are negative and count as black", file, negative));
    return map;
}

} // namespace luxel
