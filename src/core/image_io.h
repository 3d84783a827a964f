// SPDX-License-Identifier: MIT
// Image files. Untrusted input is decoded in a child process with limits (no files, memory and time caps).
// All writers write beside the target, flush and rename. Errors: Error with Fault::bad_input or Fault::io.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/error.h"
#include "core/image.h"

namespace luxel {

inline constexpr int max_image_side = 16384;

// RGBA as stored in the file (no color conversion), in 8 bits or, where the file has them, in 16.
struct Pixels {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  // width * height * 4, or empty
    bool has_alpha = false;          // the file stored an alpha channel with some value below the largest
    std::vector<std::uint16_t> wide; // the same in 16 bits; exactly one of the two holds the pixels
    std::string remark;              // what the decoder put up with, one phrase; empty: nothing

    bool is_wide() const { return !wide.empty(); }
    std::size_t bytes() const { return rgba.size() + 2 * wide.size(); }
    // Component i of width * height * 4 as a share of the largest code.
    float value(std::size_t i) const {
        return is_wide() ? float(wide[i]) * (1.0f / 65535.0f) : float(rgba[i]) * (1.0f / 255.0f);
    }
};

// What decoders put up with is said in sentences that start with the file's name.
using Remarks = std::vector<std::string>;

// PNG, JPEG or WebP by content. `name` is used in error sentences.
Pixels decode_pixels(std::span<const std::uint8_t> bytes, const std::string& name);

// Several at once: small ones share a process, which costs some milliseconds. A result or an error for each.
struct EncodedImage {
    std::span<const std::uint8_t> bytes;
    std::string name;
};
std::vector<std::variant<Pixels, Error>> decode_pixels(std::span<const EncodedImage> images);

// Radiance .hdr or OpenEXR by content: 3 or 1 channel image, linear.
Image decode_hdr(std::span<const std::uint8_t> bytes, const std::string& name, Remarks* remarks = nullptr);

// Any supported file by content: HDR as it is, the others decoded from sRGB to linear. 3 channels.
Image decode_image(std::span<const std::uint8_t> bytes, const std::string& name, Remarks* remarks = nullptr);
Image read_image(const std::filesystem::path& file, Remarks* remarks = nullptr);

// Layered EXR ("direct.R", ...); channels outside R, G, B, Y, A become one-channel layers of their full name.
// metadata: string attributes of the header, those that write_exr stored. remark: as of Pixels.
struct ExrFile {
    Layers layers;
    std::map<std::string, std::string> metadata;
    std::string remark;
};
ExrFile read_exr(const std::filesystem::path& file);
void write_exr(const std::filesystem::path& file, const Layers& layers,
               const std::map<std::string, std::string>& metadata = {});

// Display-referred values [0, 1] (see display()) to 8-bit PNG; 1, 3 or 4 channels.
void write_png(const std::filesystem::path& file, const Image& display_values);
std::vector<std::uint8_t> encode_png(const Image& display_values);

} // namespace luxel
