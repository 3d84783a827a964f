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

// The unnamed layer, or the only one, or the only one of colors: of "main.R", "main.G", "main.B" and
// "depth.Z" the colors, with a remark.
Image main_layer(ExrFile& file, const std::string& name) {
    auto chosen = file.layers.size() == 1 ? file.layers.begin() : file.layers.find("");
    if (chosen == file.layers.end()) {
        int colors = 0;
        std::string names;
        for (auto layer = file.layers.begin(); layer != file.layers.end(); ++layer) {
            names += (names.empty() ? "" : ", ") + layer->first;
            if (layer->second.channels >= 3 && ++colors == 1) chosen = layer;
        }
        if (colors != 1)
            fail(Fault::bad_input, "{}: no layer without a name among {}; keep one of them", name, names);
        file.remark +=
            (file.remark.empty() ? "" : "; ") + fmt::format("its layer \"{}\" is read", chosen->first);
    }
    Image image = std::move(chosen->second);
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

constexpr const char* not_pixels = "not PNG, JPEG or WebP";

bool holds_pixels(std::span<const std::uint8_t> bytes) {
    const Format format = codec::format_of(bytes);
    return format == Format::png || format == Format::jpeg || format == Format::webp;
}

// Formats that are known but not read are named.
std::string describe_unknown(std::span<const std::uint8_t> bytes, const char* otherwise) {
    constexpr std::string_view ktx2 = "\xabKTX 20\xbb";
    const bool is_ktx2 = bytes.size() >= ktx2.size() &&
                         std::equal(ktx2.begin(), ktx2.end(), bytes.begin(),
                                    [](char a, std::uint8_t b) { return std::uint8_t(a) == b; });
    return is_ktx2 ? "KTX2 is not read; convert it to PNG, as `ktx extract` does" : otherwise;
}

} // namespace

Pixels decode_pixels(std::span<const std::uint8_t> bytes, const std::string& name) {
    if (!holds_pixels(bytes)) fail(Fault::bad_input, "{}: {}", name, describe_unknown(bytes, not_pixels));
    return named(name, [&] { return expect<Pixels>(codec::decode_apart(bytes)); });
}

std::vector<std::variant<Pixels, Error>> decode_pixels(std::span<const EncodedImage> images) {
    constexpr std::size_t small = 256 << 10;
    std::vector<std::variant<Pixels, Error>> results;
    for (std::size_t first = 0; first < images.size();) {
        if (!holds_pixels(images[first].bytes)) {
            results.emplace_back(
                Error(Fault::bad_input,
                      images[first].name + ": " + describe_unknown(images[first].bytes, not_pixels)));
            ++first;
            continue;
        }
        // Small ones up to the next large one, which is alone.
        std::vector<std::span<const std::uint8_t>> together;
        do {
            together.push_back(images[first + together.size()].bytes);
        } while (first + together.size() < images.size() && together.back().size() <= small &&
                 images[first + together.size()].bytes.size() <= small &&
                 holds_pixels(images[first + together.size()].bytes));
        for (codec::DecodedOrError& decoded : codec::decode_apart(together)) {
            const std::string& name = images[results.size()].name;
            try {
                if (const Error* error = std::get_if<Error>(&decoded)) throw *error;
                results.emplace_back(expect<Pixels>(std::move(std::get<codec::Decoded>(decoded))));
            } catch (const Error& error) {
                results.emplace_back(Error(error.fault(), name + ": " + error.what()));
            }
        }
        first += together.size();
    }
    return results;
}

Image decode_hdr(std::span<const std::uint8_t> bytes, const std::string& name, Remarks* remarks) {
    const Format format = codec::format_of(bytes);
    if (format != Format::exr && format != Format::radiance)
        fail(Fault::bad_input, "{}: neither OpenEXR nor Radiance", name);
    ExrFile file = named(name, [&] { return expect<ExrFile>(codec::decode_apart(bytes)); });
    Image image = main_layer(file, name);
    add_remark(remarks, name, file.remark);
    return image;
}

Image decode_image(std::span<const std::uint8_t> bytes, const std::string& name, Remarks* remarks) {
    if (codec::format_of(bytes) == Format::unknown)
        fail(Fault::bad_input, "{}: {}", name,
             describe_unknown(bytes, "not OpenEXR, Radiance, PNG, JPEG or WebP"));
    if (holds_pixels(bytes)) {
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
