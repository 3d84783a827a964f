// SPDX-License-Identifier: MIT
#include "scene/gltf/uri.h"

#include <algorithm>
#include <array>

namespace luxel::gltf {
namespace {

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<std::int8_t, 256> base64_values = [] {
    std::array<std::int8_t, 256> values{};
    values.fill(-1);
    for (std::size_t i = 0; i < base64_digits.size(); ++i)
        values[static_cast<unsigned char>(base64_digits[i])] = std::int8_t(i);
    return values;
}();

int hex_value(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

// RFC 3986, section 3.1: letters, digits, "+", "-", "." before the first colon.
bool has_scheme(std::string_view uri) {
    const std::size_t colon =
        uri.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-.");
    return colon != uri.npos && colon > 0 && uri[colon] == ':';
}

bool is_data(std::string_view uri) {
    constexpr std::string_view scheme = "data:";
    return uri.size() >= scheme.size() && std::equal(scheme.begin(), scheme.end(), uri.begin(),
                                                     [](char a, char b) { return a == (b | 0x20); });
}

std::vector<std::uint8_t> decode_data(const Value& where, std::string_view uri, std::uint64_t limit) {
    const std::size_t comma = uri.find(',');
    if (comma == uri.npos || !uri.substr(0, comma).ends_with(";base64"))
        where.fail("the data URI is not base64");
    const std::string_view payload = uri.substr(comma + 1);
    if (payload.size() / 4 * 3 > limit) where.fail("the data URI is larger than {} bytes", limit);
    auto bytes = decode_base64(payload);
    if (!bytes) where.fail("the data URI is not valid base64");
    return std::move(*bytes);
}

} // namespace

std::optional<std::vector<std::uint8_t>> decode_base64(std::string_view text) {
    for (int pads = 0; pads < 2 && text.ends_with('='); ++pads) text.remove_suffix(1);
    if (text.size() % 4 == 1) return std::nullopt;
    std::vector<std::uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        const int value = base64_values[static_cast<unsigned char>(c)];
        if (value < 0) return std::nullopt;
        bits = (bits << 6) | std::uint32_t(value);
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes.push_back(std::uint8_t(bits >> held));
        }
    }
    return bytes;
}

std::string decode_percent(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int high = text[i] == '%' && i + 2 < text.size() ? hex_value(text[i + 1]) : -1;
        const int low = high >= 0 ? hex_value(text[i + 2]) : -1;
        if (low >= 0) {
            decoded.push_back(static_cast<char>(high * 16 + low));
            i += 2;
        } else {
            decoded.push_back(text[i]);
        }
    }
    return decoded;
}

std::optional<std::string> without_dots(std::string_view path) {
    std::vector<std::string_view> kept;
    while (!path.empty()) {
        const std::size_t slash = std::min(path.find('/'), path.size());
        const std::string_view component = path.substr(0, slash);
        path.remove_prefix(std::min(slash + 1, path.size()));
        if (component.empty() || component == ".") continue;
        if (component != "..") {
            kept.push_back(component);
            continue;
        }
        if (kept.empty()) return std::nullopt;
        kept.pop_back();
    }
    std::string resolved;
    for (const std::string_view component : kept) {
        if (!resolved.empty()) resolved += '/';
        resolved += component;
    }
    return resolved;
}

std::string uri_name(const std::string& uri) {
    return is_data(uri) ? std::string("data URI") : printable(decode_percent(uri));
}

std::optional<std::vector<std::uint8_t>> read_uri(const Folder& folder, const Value& where,
                                                  std::uint64_t limit) {
    const std::string& uri = where.text();
    if (is_data(uri)) return decode_data(where, uri, limit);
    if (has_scheme(uri)) where.fail("\"{}\" is neither a data URI nor a relative path", printable(uri));

    std::string path = decode_percent(uri);
    if (path.empty() || path.front() == '/' || path.find('\0') != path.npos)
        where.fail("\"{}\" is no path within the folder of the scene", printable(path));
    const auto read = [&](const std::string& from) -> std::optional<std::vector<std::uint8_t>> {
        const auto resolved = without_dots(from);
        if (!resolved) where.fail("\"{}\": the path leaves the folder", printable(from));
        if (resolved->empty()) where.fail("\"{}\" is no file", printable(from));
        return folder.read(*resolved, limit);
    };
    auto bytes = read(path);
    if (bytes || path.find('\\') == path.npos) return bytes;

    // Exporters on Windows write its separators, though URIs have but one.
    std::replace(path.begin(), path.end(), '\\', '/');
    if (path.front() == '/') return std::nullopt;
    return read(path);
}

} // namespace luxel::gltf
