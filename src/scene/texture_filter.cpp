// SPDX-License-Identifier: MIT
#include "scene/texture_filter.h"

#include <cmath>
#include <limits>
#include <vector>

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

// Codes to linear values, for both kinds of texture.
template <class Code> struct DecodeTables {
    static constexpr std::size_t largest = std::numeric_limits<Code>::max();
    std::vector<float> srgb = std::vector<float>(largest + 1), linear = srgb;
    DecodeTables() {
        for (std::size_t i = 0; i <= largest; ++i) {
            linear[i] = float(i) / float(largest);
            srgb[i] = srgb_decode(linear[i]);
        }
    }
};
template <class Code> const DecodeTables<Code>& decode_tables() {
    static const DecodeTables<Code> tables;
    return tables;
}

std::size_t texel_index(const Texture& texture, int x, int y) {
    return (std::size_t(y) * std::size_t(texture.pixels.width) + std::size_t(x)) * 4;
}

// Where a texel stands, for prefetching.
const void* texel_address(const Texture& texture, int x, int y) {
    const std::size_t i = texel_index(texture, x, y);
    return texture.pixels.is_wide() ? static_cast<const void*>(&texture.pixels.wide[i])
                                    : static_cast<const void*>(&texture.pixels.rgba[i]);
}

template <class Code> glm::vec4 decode(const Code* code, const float* color) {
    return {color[code[0]], color[code[1]], color[code[2]],
            float(code[3]) * (1.0f / float(DecodeTables<Code>::largest))};
}

template <class Code> glm::vec4 filter_codes(const Footprint& f, const std::vector<Code>& codes) {
    const DecodeTables<Code>& tables = decode_tables<Code>();
    const float* color = (f.texture->srgb ? tables.srgb : tables.linear).data();
    const auto at = [&](int x, int y) { return decode(&codes[texel_index(*f.texture, x, y)], color); };
    if (f.texture->nearest)
        return at(f.x.weight < 0.5f ? f.x.first : f.x.second, f.y.weight < 0.5f ? f.y.first : f.y.second);
    const glm::vec4 top = glm::mix(at(f.x.first, f.y.first), at(f.x.second, f.y.first), f.x.weight);
    const glm::vec4 bottom = glm::mix(at(f.x.first, f.y.second), at(f.x.second, f.y.second), f.x.weight);
    return glm::mix(top, bottom, f.y.weight);
}

} // namespace

Footprint footprint(const Texture& texture, glm::vec2 uv) {
    return {&texture, taps(uv.x, texture.pixels.width, texture.wrap_u),
            taps(uv.y, texture.pixels.height, texture.wrap_v)};
}

glm::vec4 filter(const Footprint& f) {
    const Pixels& pixels = f.texture->pixels;
    return pixels.is_wide() ? filter_codes(f, pixels.wide) : filter_codes(f, pixels.rgba);
}

glm::vec4 texel(const Texture& texture, int x, int y) {
    const Pixels& pixels = texture.pixels;
    const std::size_t i = texel_index(texture, x, y);
    const auto color = [&](const auto& tables) {
        return (texture.srgb ? tables.srgb : tables.linear).data();
    };
    return pixels.is_wide() ? decode(&pixels.wide[i], color(decode_tables<std::uint16_t>()))
                            : decode(&pixels.rgba[i], color(decode_tables<std::uint8_t>()));
}

void prefetch(const Footprint& f) {
    if (!f.texture) return;
    __builtin_prefetch(texel_address(*f.texture, f.x.first, f.y.first));
    __builtin_prefetch(texel_address(*f.texture, f.x.first, f.y.second));
}

} // namespace luxel
