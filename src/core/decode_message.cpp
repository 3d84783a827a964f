// SPDX-License-Identifier: MIT
#include "core/decode_message.h"

#include <algorithm>

#include "core/codec.h"
#include "core/error.h"

namespace luxel::codec {
namespace {

enum class Kind : std::uint32_t { refusal = 1, pixels, layers };
constexpr std::uint32_t max_text = 1 << 16, max_items = 1 << 10;

void put_number(std::uint32_t value, const Put& put) { put(&value, sizeof(value)); }

void put_text(const std::string& text, const Put& put) {
    const auto length = std::uint32_t(std::min<std::size_t>(text.size(), max_text));
    put_number(length, put);
    put(text.data(), length);
}

// Every number that sizes something comes with its bound.
std::uint32_t get_number(std::uint32_t most, const Get& get) {
    std::uint32_t value = 0;
    get(&value, sizeof(value));
    if (value > most) fail(Fault::bad_input, "the decoder answered nonsense");
    return value;
}

std::string get_text(const Get& get) {
    std::string text(get_number(max_text, get), '\0');
    get(text.data(), text.size());
    return text;
}

// Text that people will see may hold anything: one printable line of it.
std::string get_line(const Get& get) {
    std::string line = get_text(get);
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return line;
}

Pixels receive_pixels(const Get& get) {
    Pixels pixels;
    pixels.width = int(get_number(max_image_side, get));
    pixels.height = int(get_number(max_image_side, get));
    pixels.has_alpha = get_number(1, get) == 1;
    const bool wide = get_number(1, get) == 1;
    check_size(std::uint64_t(pixels.width), std::uint64_t(pixels.height), wide ? 8 : 4);
    const std::size_t count = std::size_t(pixels.width) * std::size_t(pixels.height) * 4;
    if (wide) {
        pixels.wide.resize(count);
        get(pixels.wide.data(), 2 * count);
    } else {
        pixels.rgba.resize(count);
        get(pixels.rgba.data(), count);
    }
    pixels.remark = get_line(get);
    return pixels;
}

ExrFile receive_layers(const Get& get) {
    ExrFile file;
    std::uint64_t channels = 0;
    for (std::uint32_t left = get_number(max_items, get); left > 0; --left) {
        std::string name = get_text(get);
        const std::uint32_t width = get_number(max_image_side, get), height = get_number(max_image_side, get);
        const std::uint32_t count = get_number(4, get);
        channels += count;
        check_size(width, height, channels * sizeof(float));
        Image image{int(width), int(height), int(count)};
        get(image.data.data(), image.data.size() * sizeof(float));
        file.layers[std::move(name)] = std::move(image);
    }
    for (std::uint32_t left = get_number(max_items, get); left > 0; --left) {
        std::string name = get_text(get);
        file.metadata[std::move(name)] = get_text(get);
    }
    file.remark = get_line(get);
    return file;
}

} // namespace

void send_refusal(const std::string& reason, const Put& put) {
    put_number(std::uint32_t(Kind::refusal), put);
    put_text(reason, put);
}

void send(const Decoded& decoded, const Put& put) {
    if (const auto* pixels = std::get_if<Pixels>(&decoded)) {
        put_number(std::uint32_t(Kind::pixels), put);
        put_number(std::uint32_t(pixels->width), put);
        put_number(std::uint32_t(pixels->height), put);
        put_number(pixels->has_alpha, put);
        put_number(pixels->is_wide(), put);
        put(pixels->rgba.data(), pixels->rgba.size());
        put(pixels->wide.data(), 2 * pixels->wide.size());
        put_text(pixels->remark, put);
        return;
    }
    const auto& file = std::get<ExrFile>(decoded);
    put_number(std::uint32_t(Kind::layers), put);
    put_number(std::uint32_t(file.layers.size()), put);
    for (const auto& [name, image] : file.layers) {
        put_text(name, put);
        put_number(std::uint32_t(image.width), put);
        put_number(std::uint32_t(image.height), put);
        put_number(std::uint32_t(image.channels), put);
        put(image.data.data(), image.data.size() * sizeof(float));
    }
    put_number(std::uint32_t(file.metadata.size()), put);
    for (const auto& [name, value] : file.metadata) {
        put_text(name, put);
        put_text(value, put);
    }
    put_text(file.remark, put);
}

Decoded receive(const Get& get) {
    switch (Kind(get_number(std::uint32_t(Kind::layers), get))) {
    case Kind::refusal:
        fail(Fault::bad_input, "{}", get_line(get));
    case Kind::pixels:
        return receive_pixels(get);
    case Kind::layers:
        return receive_layers(get);
    }
    fail(Fault::bad_input, "the decoder answered nonsense");
}

} // namespace luxel::codec
