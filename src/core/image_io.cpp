// SPDX-License-Identifier: MIT
// Image files by content.
#include "core/image_io.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/codec.h"
#include "core/decode_process.h"
#include "core/error.h"
#include "core/file.h"

namespace luxel {
namespace {

using codec::Format;

// The decoders give the reason; the sentence starts with the file.
template <class Decode> auto named(const std::string& name, Decode&& decode) {
    try {
        return decode();
    } catch (const Error& error) {
        fail(error.fault(), "{}: {}", name, error.what());
    }
}

// A decoder that an image has taken over might answer with the other kind.
template <class Kind> Kind expect(codec::Decoded decoded) {
    if (Kind* kind = std::get_if<Kind>(&decoded)) return std::move(*kind);
    fail(Fault::bad_input, "the decoder answered nonsense");
}

Image three_channels(const Image& image) {
    Image color(image.width, image.height, 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) color.set_rgb(x, y, image.rgb(x, y));
    return color;
}

// The unnamed layer, or the only one.
Image main_layer(ExrFile file, const std::string& name) {
    const auto unnamed = file.layers.find("");
    if (unnamed == file.layers.end() && file.layers.size() != 1) {
        std::string names;
        for (const auto& [layer, image] : file.layers) names += (names.empty() ? "" : ", ") + layer;
        fail(Fault::bad_input, "{}: no layer without a name among {}", name, names);
    }
    Image image = std::move(unnamed != file.layers.end() ? unnamed->second : file.layers.begin()->second);
    return image.channels == 4 ? three_channels(image) : image;
}

// Eight bits have few enough codes for a table.
Image linear(const Pixels& pixels) {
    std::array<float, 256> table;
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = srgb_decode(float(i) / 255.0f);
    Image image(pixels.width, pixels.height, 3);
    for (std::size_t i = 0; i < image.pixels(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            image.data[3 * i + c] =
                pixels.is_wide() ? srgb_decode(pixels.value(4 * i + c)) : table[pixels.rgba[4 * i + c]];
    return image;
}

void add_remark(Remarks* remarks, const std::string& name, const std::string& remark) {
    if (remarks && !remark.empty()) remarks->push_back(name + ": " + remark);
}

} // namespace

Pixels decode_pixels(std::span<const std::uint8_t> bytes, const std::string& name) {
    const Format format = codec::format_of(bytes);
    if (format != Format::png && format != Format::jpeg)
        fail(Fault::bad_input, "{}: neither PNG nor JPEG", name);
    return named(name, [&] { return expect<Pixels>(codec::decode_apart(bytes)); });
}

Image decode_hdr(std::span<const std::uint8_t> bytes, const std::string& name, Remarks* remarks) {
    const Format format = codec::format_of(bytes);
    if (format != Format::exr && format != Format::radiance)
        fail(Fault::bad_input, "{}: neither OpenEXR nor Radiance", name);
    ExrFile file = named(name, [&] { return expect<ExrFile>(codec::decode_apart(bytes)); });
    add_remark(remarks, name, file.remark);
    return main_layer(std::move(file), name);
}

Image decode_image(std::span<const std::uint8_t> bytes, const std::string& name, Remarks* remarks) {
    const Format format = codec::format_of(bytes);
    if (format == Format::unknown) fail(Fault::bad_input, "{}: not OpenEXR, Radiance, PNG or JPEG", name);
    if (format == Format::png || format == Format::jpeg) {
        const Pixels pixels = decode_pixels(bytes, name);
        add_remark(remarks, name, pixels.remark);
        return linear(pixels);
    }
    Image image = decode_hdr(bytes, name, remarks);
    return image.channels == 3 ? image : three_channels(image);
}

Image read_image(const std::filesystem::path& file, Remarks* remarks) {
    return decode_image(read_file(file), file.string(), remarks);
}

ExrFile read_exr(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = read_file(file);
    if (codec::format_of(bytes) != Format::exr) fail(Fault::bad_input, "{}: not OpenEXR", file.string());
    return named(file.string(), [&] { return expect<ExrFile>(codec::decode_apart(bytes)); });
}

} // namespace luxel
