// SPDX-License-Identifier: MIT
// The EXR header, checked before OpenEXR sees the file [OpenEXR file layout: magic, version, attributes].
#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "core/codec.h"
#include "core/error.h"

namespace luxel::codec {
namespace {

constexpr std::size_t max_channels = 256;
constexpr int max_parts = 65;

// Reads little-endian values; every read is checked.
class Reader {
public:
    explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    std::span<const std::uint8_t> take(std::uint64_t count) {
        if (count > bytes_.size()) fail(Fault::bad_input, "the EXR header is cut off");
        const auto taken = bytes_.first(count);
        bytes_ = bytes_.subspan(count);
        return taken;
    }
    std::uint32_t word() {
        const auto b = take(4);
        return std::uint32_t(b[0]) | std::uint32_t(b[1]) << 8 | std::uint32_t(b[2]) << 16 |
               std::uint32_t(b[3]) << 24;
    }
    std::int64_t integer() { return std::int32_t(word()); }
    std::uint8_t byte() { return take(1)[0]; }
    // A zero-terminated name of at most 255 characters.
    std::string_view name() {
        const auto limit = std::min<std::size_t>(bytes_.size(), 256);
        const auto end = std::find(bytes_.begin(), bytes_.begin() + std::ptrdiff_t(limit), 0);
        if (end == bytes_.begin() + std::ptrdiff_t(limit))
            fail(Fault::bad_input, "a name in the EXR header is not closed");
        const auto text = take(std::uint64_t(end - bytes_.begin()));
        take(1);
        return {reinterpret_cast<const char*>(text.data()), text.size()};
    }

private:
    std::span<const std::uint8_t> bytes_;
};

std::size_t check_channels(Reader reader) {
    std::size_t count = 0;
    for (std::string_view name = reader.name(); !name.empty(); name = reader.name()) {
        const std::uint32_t type = reader.word();
        reader.take(4); // pLinear, reserved
        const std::int64_t x_sampling = reader.integer(), y_sampling = reader.integer();
        if (type > 2) fail(Fault::bad_input, "EXR channel {} has the unknown type {}", name, type);
        if ((x_sampling != 1 || y_sampling != 1) && (name.ends_with("RY") || name.ends_with("BY")))
            fail(Fault::bad_input,
                 "EXR in luminance and chroma (channel {}) is not supported; convert it to RGB", name);
        if (x_sampling != 1 || y_sampling != 1)
            fail(Fault::bad_input, "EXR channel {} is subsampled, which is not supported", name);
        if (++count > max_channels) fail(Fault::bad_input, "more than {} EXR channels", max_channels);
    }
    if (count == 0) fail(Fault::bad_input, "no EXR channels");
    return count;
}

void check_tiles(Reader reader) {
    const std::uint32_t width = reader.word(), height = reader.word();
    const std::uint8_t mode = reader.byte();
    if (width < 1 || height < 1 || width > max_image_side || height > max_image_side)
        fail(Fault::bad_input, "EXR tiles of {}x{}", width, height);
    if ((mode & 15) != 0) fail(Fault::bad_input, "EXR tiles with several levels are not supported");
}

using Size = std::pair<std::uint64_t, std::uint64_t>;

Size check_window(Reader box, const char* which) {
    const std::int64_t x0 = box.integer(), y0 = box.integer(), x1 = box.integer(), y1 = box.integer();
    if (x1 < x0 || y1 < y0) fail(Fault::bad_input, "the EXR {} window is empty", which);
    return {std::uint64_t(x1 - x0 + 1), std::uint64_t(y1 - y0 + 1)};
}

// One part's attributes, up to the empty name that ends them. False: there was none, the list of parts ends.
bool check_part(Reader& reader, bool tiled) {
    std::optional<std::size_t> channels;
    std::optional<Size> data, shown;
    std::set<std::string, std::less<>> seen;
    for (std::string_view name = reader.name(); !name.empty(); name = reader.name()) {
        if (!seen.emplace(name).second) fail(Fault::bad_input, "the EXR attribute {} occurs twice", name);
        reader.name(); // type
        const Reader value(reader.take(reader.word()));
        if (name == "channels") channels = check_channels(value);
        if (name == "tiles") check_tiles(value);
        if (name == "dataWindow") data = check_window(value, "data");
        if (name == "displayWindow") shown = check_window(value, "display");
    }
    if (seen.empty()) return false;

    for (const char* required : {"channels", "compression", "dataWindow", "displayWindow", "lineOrder"})
        if (!seen.contains(required)) fail(Fault::bad_input, "the EXR attribute {} is missing", required);
    if (tiled && !seen.contains("tiles")) fail(Fault::bad_input, "the EXR attribute tiles is missing");
    check_size(data->first, data->second, 4 * *channels);
    check_size(shown->first, shown->second, 4 * *channels);
    return true;
}

} // namespace

ExrHeader check_exr_header(std::span<const std::uint8_t> bytes) {
    Reader reader(bytes);
    if (reader.word() != 20000630) fail(Fault::bad_input, "not an EXR file");
    const std::uint32_t version = reader.word();
    if ((version & 0xff) != 2) fail(Fault::bad_input, "EXR version {} is not supported", version & 0xff);
    if (version & 0x800) fail(Fault::bad_input, "deep EXR is not supported");

    ExrHeader header{.parts = 0};
    const bool several = (version & 0x1000) != 0;
    while (header.parts < (several ? max_parts : 1) && check_part(reader, (version & 0x200) != 0))
        ++header.parts;
    if (header.parts == 0) fail(Fault::bad_input, "the EXR file has no header");
    if (several && header.parts == max_parts) fail(Fault::bad_input, "more than {} EXR parts", max_parts - 1);
    return header;
}

} // namespace luxel::codec
