// SPDX-License-Identifier: MIT
// Decoding of untrusted image bytes in the process luxel-decode: it opens nothing, its memory and time are
// capped, and a fault in a codec ends it, not us.
#pragma once
#include <cstdint>
#include <span>
#include <variant>

#include "core/error.h"
#include "core/image_io.h"

namespace luxel::codec {

using Decoded = std::variant<ExrFile, Pixels>;

// EXR and Radiance give ExrFile, PNG, JPEG and WebP give Pixels. Error with the reason alone, without a file
// name.
Decoded decode_apart(std::span<const std::uint8_t> bytes);
// Several by one process, as long as none ends it.
using DecodedOrError = std::variant<Decoded, Error>;
std::vector<DecodedOrError> decode_apart(std::span<const std::span<const std::uint8_t>> images);

// The other side, main() of luxel-decode: images on standard input, answers on standard output.
[[noreturn]] void decode_and_exit();

} // namespace luxel::codec
