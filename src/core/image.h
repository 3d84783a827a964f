// SPDX-License-Identifier: MIT
// Float images on the CPU. Row 0 is the top; channels are interleaved; color is linear sRGB radiance.
#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace luxel {

struct Image {
    int width = 0, height = 0, channels = 0;
    std::vector<float> data; // width * height * channels

    Image() = default;
    Image(int w, int h, int c, float fill = 0.0f)
        : width(w), height(h), channels(c), data(std::size_t(w) * std::size_t(h) * std::size_t(c), fill) {}

    bool empty() const { return data.empty(); }
    std::size_t pixels() const { return std::size_t(width) * std::size_t(height); }
    float* at(int x, int y) { return &data[(std::size_t(y) * std::size_t(width) + std::size_t(x)) * std::size_t(channels)]; }
    const float* at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
    glm::vec3 rgb(int x, int y) const {
        const float* p = at(x, y);
        return channels >= 3 ? glm::vec3(p[0], p[1], p[2]) : glm::vec3(p[0]);
    }
    void set_rgb(int x, int y, glm::vec3 c) {
        float* p = at(x, y);
        p[0] = c.r, p[1] = c.g, p[2] = c.b;
    }
};

// Same size, named by component ("diffuse1", "direct"); the layers of one EXR file. "" is the unnamed layer.
using Layers = std::map<std::string, Image>;

// Rec. 709 luminance of linear sRGB.
inline float luminance(glm::vec3 c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

// Display transform, the same for every picture of one view: clamp(exposure * radiance) to [0, 1], sRGB curve.
float srgb_encode(float linear); // [0, 1] -> [0, 1]
float srgb_decode(float encoded);
Image display(const Image& radiance, float exposure);

// The exposure that sends the 98th percentile of the reference to 1, taken over blocks of 1/48 of the height, whose
// means hardly depend on noise; a block's level is its brightest channel, so that the color of a lamp does not
// matter. mask (1 channel, may be empty): only pixels > 0 count. A black image gives 1.
float exposure_of(const Image& reference, const Image& mask);

} // namespace luxel
