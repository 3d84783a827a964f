// SPDX-License-Identifier: MIT
// Image files. Untrusted input is decoded in a child process with limits (no files, memory and time caps).
// All writers write beside the target, flush and rename. Errors: Error with Fault::bad_input or Fault::io.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/image.h"

namespace luxel {

inline constexpr int max_image_side = 16384;

// 8-bit RGBA as stored in the file (no color conversion); sources with 16 bits are rounded to 8.
struct Pixels8 {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba; // width * height * 4
    bool has_alpha = false;         // the file stored an alpha channel with some value below 255
};

// PNG or JPEG by content. `name` is used in error sentences.
Pixels8 decode_pixels(std::span<const std::uint8_t> bytes, const std::string& name);

// Radiance .hdr or OpenEXR by content: 3 or 1 channel image, linear.
Image decode_hdr(std::span<const std::uint8_t> bytes, const std::string& name);

// Any supported file by content: HDR as it is, PNG and JPEG decoded from sRGB to linear. 3 channels.
Image read_image(const std::filesystem::path& file);

// Layered EXR ("direct.R", ...); channels outside R, G, B, Y, A become one-channel layers of their full name.
// metadata: string attributes of the header, those that write_exr stored.
struct ExrFile {
    Layers layers;
    std::map<std::string, std::string> metadata;
};
ExrFile read_exr(const std::filesystem::path& file);
void write_exr(const std::filesystem::path& file, const Layers& layers,
               const std::map<std::string, std::string>& metadata = {});

// Display-referred values [0, 1] (see display()) to 8-bit PNG; 1, 3 or 4 channels.
void write_png(const std::filesystem::path& file, const Image& display_values);
std::vector<std::uint8_t> encode_png(const Image& display_values);

} // namespace luxel
