// SPDX-License-Identifier: MIT
// Decoding of untrusted image bytes in the process luxel-decode: it opens nothing, its memory and time are
// capped, and a fault in a codec ends it, not us.
#pragma once
#include <cstdint>
#include <span>
#include <variant>

#include "core/image_io.h"

namespace luxel::codec {

using Decoded = std::variant<ExrFile, Pixels>;

// EXR and Radiance give ExrFile, PNG and JPEG give Pixels. Error with the reason alone, without a file name.
Decoded decode_apart(std::span<const std::uint8_t> bytes);

// The other side, main() of luxel-decode: an image on standard input, the answer on standard output.
[[noreturn]] void decode_and_exit();

} // namespace luxel::codec
