// SPDX-License-Identifier: MIT
#include "scene/texture_filter.h"

#include <array>
#include <cmath>

namespace luxel {
namespace {

// std::floor is a call on processors without SSE 4.1.
float floor_of(float x) {
    if (!(std::abs(x) < 8388608.0f)) return x; // no fraction left
    float truncated = float(int(x));
    return truncated > x ? truncated - 1.0f : truncated;
}

Taps taps(float coordinate, int size, Wrap wrap) {
    // Bring the coordinate into one period first, so that its fraction keeps its bits.
    if (wrap == Wrap::repeat) coordinate -= floor_of(coordinate);
    if (wrap == Wrap::mirror) {
        coordinate -= 2.0f * floor_of(coordinate * 0.5f);
        if (coordinate > 1.0f) coordinate = 2.0f - coordinate;
    }
    float x = glm::clamp(coordinate, -1.0f, 2.0f) * float(size) - 0.5f;
    float low = floor_of(x);
    int first = int(low), second = first + 1;

    // Beside the border, repeating goes on at the other end; mirroring and clamping see the border texel
    // twice.
    if (wrap == Wrap::repeat) {
        if (first < 0) first += size;
        if (second >= size) second -= size;
    }
    return {glm::clamp(first, 0, size - 1), glm::clamp(second, 0, size - 1), x - low};
}

// 8-bit codes to linear values, for both kinds of texture.
struct DecodeTables {
    std::array<float, 256> srgb, linear;
    DecodeTables() {
        for (int i = 0; i < 256; ++i) {
            linear[std::size_t(i)] = float(i) / 255.0f;
            srgb[std::size_t(i)] = srgb_decode(linear[std::size_t(i)]);
        }
    }
};
const DecodeTables& decode_tables() {
    static const DecodeTables tables;
    return tables;
}

const std::uint8_t* texel_address(const Texture& texture, int x, int y) {
    const Pixels8& p = texture.pixels;
    return &p.rgba[(std::size_t(y) * std::size_t(p.width) + std::size_t(x)) * 4];
}

glm::vec4 texel(const Texture& texture, const std::array<float, 256>& color, int x, int y) {
    const std::uint8_t* t = texel_address(texture, x, y);
    return {color[t[0]], color[t[1]], color[t[2]], float(t[3]) * (1.0f / 255.0f)};
}

} // namespace

Footprint footprint(const Texture& texture, glm::vec2 uv) {
    return {&texture, taps(uv.x, texture.pixels.width, texture.wrap_u),
            taps(uv.y, texture.pixels.height, texture.wrap_v)};
}

glm::vec4 filter(const Footprint& f) {
    const DecodeTables& tables = decode_tables();
    const std::array<float, 256>& color = f.texture->srgb ? tables.srgb : tables.linear;
    if (f.texture->nearest)
        return texel(*f.texture, color, f.x.weight < 0.5f ? f.x.first : f.x.second,
                     f.y.weight < 0.5f ? f.y.first : f.y.second);
    glm::vec4 top = glm::mix(texel(*f.texture, color, f.x.first, f.y.first),
                             texel(*f.texture, color, f.x.second, f.y.first), f.x.weight);
    glm::vec4 bottom = glm::mix(texel(*f.texture, color, f.x.first, f.y.second),
                                texel(*f.texture, color, f.x.second, f.y.second), f.x.weight);
    return glm::mix(top, bottom, f.y.weight);
}

void prefetch(const Footprint& f) {
    if (!f.texture) return;
    __builtin_prefetch(texel_address(*f.texture, f.x.first, f.y.first));
    __builtin_prefetch(texel_address(*f.texture, f.x.first, f.y.second));
}

} // namespace luxel
