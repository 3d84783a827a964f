// SPDX-License-Identifier: MIT
// SPIR-V embedded in the program by the build.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace luxel::gpu {

struct EmbeddedShader {
    std::string_view name; // "isr/gather.comp"
    struct Words {
        const std::uint32_t *begin = nullptr, *end = nullptr;
    } words;
};
std::span<const EmbeddedShader> embedded_shaders();

} // namespace luxel::gpu
