// SPDX-License-Identifier: MIT
// Radiance RGBE pictures [Ward, "Real Pixels", Graphics Gems II; the file format of Radiance's color.c]:
// flat, old run lengths and new run lengths, -Y +X order.
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "core/codec.h"
#include "core/error.h"

namespace luxel::codec {
namespace {

constexpr std::size_t max_line = 4096, max_lines = 1024;

class Reader {
public:
    explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    std::uint8_t byte() {
        need(1);
        return bytes_[at_++];
    }
    void need(std::size_t count) const {
        if (count > bytes_.size() - at_) fail(Fault::bad_input, "Radiance: the file ends early");
    }
    std::uint8_t peek(std::size_t ahead) const {
        need(ahead + 1);
        return bytes_[at_ + ahead];
    }
    std::string_view line() {
        const std::size_t start = at_;
        while (byte() != '\n')
            if (at_ - start > max_line) fail(Fault::bad_input, "Radiance: a header line is too long");
        std::string_view text(reinterpret_cast<const char*>(bytes_.data() + start), at_ - start - 1);
        if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
        return text;
    }

private:
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

using Rgbe = std::array<std::uint8_t, 4>;

// FORMAT must be RGBE where it is given; EXPOSURE and the like are left to whoever displays the picture.
void read_header(Reader& reader) {
    if (const auto magic = reader.line(); !magic.starts_with("#?"))
        fail(Fault::bad_input, "Radiance: no #? line");
    for (std::size_t count = 0; count < max_lines; ++count) {
        const std::string_view line = reader.line();
        if (line.empty()) return;
        if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
            fail(Fault::bad_input, "Radiance: {} is not supported, only 32-bit_rle_rgbe", line);
    }
    fail(Fault::bad_input, "Radiance: more than {} header lines", max_lines);
}

std::pair<int, int> read_resolution(std::string_view line) {
    const auto refuse = [&] {
        fail(Fault::bad_input, "Radiance: resolution \"{}\"; only -Y height +X width is supported", line);
    };
    const auto number = [&](std::string_view axis) {
        int value = 0;
        if (!line.starts_with(axis)) refuse();
        const char* first = line.data() + axis.size();
        const auto [end, error] = std::from_chars(first, line.data() + line.size(), value);
        if (error != std::errc() || value < 1) refuse();
        line.remove_prefix(std::size_t(end - line.data()));
        return value;
    };
    const int height = number("-Y "), width = number(" +X ");
    if (!line.empty()) refuse();
    check_size(std::uint64_t(width), std::uint64_t(height), 3 * sizeof(float));
    return {width, height};
}

// New run lengths: the four components apart, each in runs (128 + n, value) and literals (n, values...).
void read_components(Reader& reader, std::span<Rgbe> row) {
    for (std::size_t component = 0; component < 4; ++component)
        for (std::size_t x = 0; x < row.size();) {
            const std::uint8_t code = reader.byte();
            const bool run = code > 128;
            const std::size_t count = run ? code - 128u : code;
            if (count == 0 || count > row.size() - x)
                fail(Fault::bad_input, "Radiance: a run leaves its row");
            const std::uint8_t value = run ? reader.byte() : 0;
            for (const std::size_t end = x + count; x < end; ++x)
                row[x][component] = run ? value : reader.byte();
        }
}

// Flat pixels with old run lengths: (1, 1, 1, n) repeats the last pixel, further ones count in higher bytes.
void read_pixels(Reader& reader, std::span<Rgbe> row) {
    int shift = 0;
    for (std::size_t x = 0; x < row.size();) {
        const Rgbe pixel = {reader.byte(), reader.byte(), reader.byte(), reader.byte()};
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            row[x++] = pixel;
            shift = 0;
            continue;
        }
        if (x == 0 || shift > 16) fail(Fault::bad_input, "Radiance: a run without a pixel to repeat");
        const std::size_t count = std::size_t(pixel[3]) << shift;
        if (count > row.size() - x) fail(Fault::bad_input, "Radiance: a run leaves its row");
        for (const std::size_t end = x + count; x < end; ++x) row[x] = row[x - 1];
        shift += 8;
    }
}

void read_row(Reader& reader, std::span<Rgbe> row) {
    const bool fits = row.size() >= 8 && row.size() <= 0x7fff;
    const bool components = fits && reader.peek(0) == 2 && reader.peek(1) == 2 && reader.peek(2) < 128;
    if (!components) return read_pixels(reader, row);
    const std::size_t width = std::size_t(reader.peek(2)) << 8 | reader.peek(3);
    if (width != row.size())
        fail(Fault::bad_input, "Radiance: a row of {} pixels instead of {}", width, row.size());
    for (int i = 0; i < 4; ++i) reader.byte();
    read_components(reader, row);
}

// Ward's decoding adds half a step: the mantissa was truncated.
glm::vec3 to_radiance(const Rgbe& pixel) {
    if (pixel[3] == 0) return glm::vec3(0.0f);
    const float scale = std::ldexp(1.0f, int(pixel[3]) - (128 + 8));
    return scale * (glm::vec3(pixel[0], pixel[1], pixel[2]) + 0.5f);
}

} // namespace

Image decode_radiance(std::span<const std::uint8_t> bytes) {
    Reader reader(bytes);
    read_header(reader);
    const auto [width, height] = read_resolution(reader.line());
    // A row takes at least eight bytes with component runs, four otherwise: refuse before the memory is
    // taken.
    reader.need(std::size_t(height) * 4);
    Image image(width, height, 3);
    std::vector<Rgbe> row(static_cast<std::size_t>(width));
    for (int y = 0; y < height; ++y) {
        read_row(reader, row);
        for (int x = 0; x < width; ++x) image.set_rgb(x, y, to_radiance(row[std::size_t(x)]));
    }
    return image;
}

} // namespace luxel::codec
