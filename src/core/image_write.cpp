// SPDX-License-Identifier: MIT
// Layered OpenEXR and 8-bit PNG, written whole or not at all.
#include <algorithm>
#include <array>
#include <cmath>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <png.h>

#include "core/error.h"
#include "core/file.h"
#include "core/image_io.h"

namespace luxel {

void write_exr(const std::filesystem::path& file, const Layers& layers,
               const std::map<std::string, std::string>& metadata) {
    LUXEL_ASSERT(!layers.empty(), "{}", file.string());
    const Image& first = layers.begin()->second;
    Imf::Header header(first.width, first.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [name, value] : metadata) header.insert(name, Imf::StringAttribute(value));

    Imf::FrameBuffer frame;
    for (const auto& [layer, image] : layers) {
        LUXEL_ASSERT(image.width == first.width && image.height == first.height && !image.empty() &&
                         (image.channels == 1 || image.channels == 3 || image.channels == 4),
                     "layer {} is {}x{}x{}", layer, image.width, image.height, image.channels);
        const char* parts = image.channels == 1 ? "Y" : "RGBA";
        for (int c = 0; c < image.channels; ++c) {
            const std::string name = (layer.empty() ? "" : layer + ".") + parts[c];
            const std::size_t step = sizeof(float) * std::size_t(image.channels);
            // OpenEXR's one slice type serves reading and writing; writing leaves the pixels alone.
            float* base = const_cast<float*>(image.data.data()) + c;
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(base), step,
                                          step * std::size_t(image.width)));
        }
    }

    write_atomically(file, [&](const std::filesystem::path& temporary) {
        try {
            Imf::OutputFile output(temporary.c_str(), header);
            output.setFrameBuffer(frame);
            output.writePixels(first.height);
        } catch (const std::exception& error) {
            fail(Fault::io, "{}: cannot write: {}", file.string(), error.what());
        }
    });
}

std::vector<std::uint8_t> encode_png(const Image& display_values) {
    const Image& image = display_values;
    LUXEL_ASSERT(!image.empty() && (image.channels == 1 || image.channels == 3 || image.channels == 4),
                 "{}x{}x{}", image.width, image.height, image.channels);
    std::vector<std::uint8_t> pixels(image.data.size());
    std::transform(image.data.begin(), image.data.end(), pixels.begin(), [](float value) {
        return std::uint8_t(std::lround(255.0f * (value > 0.0f ? std::min(value, 1.0f) : 0.0f)));
    });

    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = png_uint_32(image.width);
    png.height = png_uint_32(image.height);
    png.format = image.channels == 1   ? PNG_FORMAT_GRAY
                 : image.channels == 3 ? PNG_FORMAT_RGB
                                       : PNG_FORMAT_RGBA;
    std::vector<std::uint8_t> bytes(PNG_IMAGE_PNG_SIZE_MAX(png));
    png_alloc_size_t size = bytes.size();
    const int written = png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels.data(), 0, nullptr);
    LUXEL_ASSERT(written != 0, "libpng: {}", png.message);
    bytes.resize(size);
    return bytes;
}

void write_png(const std::filesystem::path& file, const Image& display_values) {
    write_file(file, encode_png(display_values));
}

} // namespace luxel
