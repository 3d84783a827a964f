// SPDX-License-Identifier: MIT
// The side of the decoding process that sees untrusted bytes.
#include <new>
#include <optional>

#include <unistd.h>

#include "core/codec.h"
#include "core/decode_message.h"
#include "core/decode_process.h"
#include "core/descriptor.h"
#include "core/error.h"
#include "core/sandbox.h"

namespace luxel::codec {
namespace {

// Exactly count bytes of the input; false at its end.
bool read_input(void* target, std::size_t count) {
    auto* at = static_cast<char*>(target);
    while (count > 0) {
        const ssize_t got = read(STDIN_FILENO, at, count);
        if (got <= 0) return false;
        at += got;
        count -= std::size_t(got);
    }
    return true;
}

// The next image; nullopt: that was all.
std::optional<std::vector<std::uint8_t>> next_image() {
    std::uint64_t length = 0;
    if (!read_input(&length, sizeof length)) return std::nullopt;
    std::vector<std::uint8_t> bytes(length);
    if (!read_input(bytes.data(), bytes.size())) return std::nullopt;
    return bytes;
}

Decoded decode(std::span<const std::uint8_t> bytes) {
    switch (format_of(bytes)) {
    case Format::exr:
        return decode_exr(bytes);
    case Format::png:
        return decode_png(bytes);
    case Format::jpeg:
        return decode_jpeg(bytes);
    case Format::webp:
        return decode_webp(bytes);
    case Format::radiance:
        return ExrFile{.layers = {{"", decode_radiance(bytes)}}, .metadata = {}, .remark = {}};
    case Format::unknown:
        break;
    }
    fail(Fault::bad_input, "not OpenEXR, Radiance, PNG, JPEG or WebP");
}

void add_remark(Decoded& decoded, const char* remark) {
    std::visit([&](auto& kind) { kind.remark += (kind.remark.empty() ? "" : "; ") + std::string(remark); },
               decoded);
}

} // namespace

void decode_and_exit() {
    const bool filtered = enter_sandbox();
    // Nobody is left to read it where this fails.
    const Put put = [](const void* bytes, std::size_t count) {
        if (!write_all(STDOUT_FILENO, bytes, count)) _exit(1);
    };
    try {
        while (const auto bytes = next_image()) {
            Decoded decoded = decode(*bytes);
            if (!filtered)
                add_remark(decoded, "decoded without a filter of system calls, which this kernel refuses");
            send(decoded, put);
        }
    } catch (const std::bad_alloc&) {
        send_refusal("decoding takes more memory than allowed", put);
    } catch (const std::exception& error) {
        send_refusal(error.what(), put);
    }
    // Nothing is left to flush; leak checkers could not open what they need.
    _exit(0);
}

} // namespace luxel::codec
