// SPDX-License-Identifier: MIT
#include "techniques/frame/texture_levels.h"

#include <algorithm>

#include "core/parallel.h"
#include "scene/surface.h"
#include "scene/texture_filter.h"

namespace luxel {
namespace {

// The part of [begin, end) that lies in texel i.
float overlap(int i, float begin, float end) {
    return std::max(0.0f, std::min(end, float(i + 1)) - std::max(begin, float(i)));
}

// The share of a texel's square where alpha reaches the cutoff, by the middles of 8 x 8 parts; where no
// texel around it is on the other side, without looking.
float coverage(const Texture& texture, int x, int y, float cutoff) {
    const glm::vec2 size(texture.pixels.width, texture.pixels.height);
    const auto reaches = [&](float u, float v) {
        return sample_texture(texture, glm::vec2(float(x) + u, float(y) + v) / size).a >= cutoff;
    };
    const bool middle = reaches(0.5f, 0.5f);
    if (texture.nearest) return middle ? 1.0f : 0.0f;
    bool mixed = false;
    for (int i = 0; i < 9 && !mixed; ++i) mixed = reaches(float(i % 3) - 0.5f, float(i / 3) - 0.5f) != middle;
    if (!mixed) return middle ? 1.0f : 0.0f;
    constexpr int parts = 8;
    int covered = 0;
    for (int i = 0; i < parts * parts; ++i)
        covered +=
            reaches((float(i % parts) + 0.5f) / float(parts), (float(i / parts) + 0.5f) / float(parts));
    return float(covered) / float(parts * parts);
}

// Color times coverage, with coverage in alpha, and plain colors for where nothing is covered.
struct Levels {
    Image color, premultiplied;
};

Levels largest(const Texture& texture, std::optional<float> cutoff) {
    const int width = texture.pixels.width, height = texture.pixels.height;
    Levels levels{Image(width, height, 4), cutoff ? Image(width, height, 4) : Image()};
    parallel_for(std::size_t(height), 16, [&](std::size_t row) {
        const int y = int(row);
        for (int x = 0; x < width; ++x) {
            const glm::vec4 t = texel(texture, x, y);
            for (int c = 0; c < 4; ++c) levels.color.at(x, y)[c] = t[c];
            if (!cutoff) continue;
            const float share = coverage(texture, x, y, *cutoff);
            for (int c = 0; c < 3; ++c) levels.premultiplied.at(x, y)[c] = t[c] * share;
            levels.premultiplied.at(x, y)[3] = share;
        }
    });
    return levels;
}

Image divided(const Levels& levels) {
    Image out = levels.premultiplied;
    for (std::size_t i = 0; i < out.data.size(); i += 4) {
        const float share = out.data[i + 3];
        for (std::size_t c = 0; c < 3; ++c)
            out.data[i + c] = share > 0.0f ? out.data[i + c] / share : levels.color.data[i + c];
    }
    return out;
}

} // namespace

Image half_size(const Image& level) {
    const int width = std::max(1, level.width / 2), height = std::max(1, level.height / 2);
    const float step_x = float(level.width) / float(width), step_y = float(level.height) / float(height);
    Image out(width, height, level.channels);
    parallel_for(std::size_t(height), 16, [&](std::size_t row) {
        const int y = int(row);
        const float top = float(y) * step_y, bottom = float(y + 1) * step_y;
        for (int x = 0; x < width; ++x) {
            const float left = float(x) * step_x, right = float(x + 1) * step_x;
            for (int v = int(top); v < level.height && float(v) < bottom; ++v)
                for (int u = int(left); u < level.width && float(u) < right; ++u) {
                    const float weight =
                        overlap(u, left, right) * overlap(v, top, bottom) / (step_x * step_y);
                    for (int c = 0; c < level.channels; ++c) out.at(x, y)[c] += level.at(u, v)[c] * weight;
                }
        }
    });
    return out;
}

std::vector<Image> texture_levels(const Texture& texture, std::optional<float> cutoff) {
    Levels levels = largest(texture, cutoff);
    std::vector<Image> out = {levels.color};
    while (out.back().width > 1 || out.back().height > 1) {
        levels.color = half_size(levels.color);
        if (cutoff) levels.premultiplied = half_size(levels.premultiplied);
        out.push_back(cutoff ? divided(levels) : levels.color);
    }
    return out;
}

} // namespace luxel
