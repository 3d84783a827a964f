// SPDX-License-Identifier: MIT
// Textures decoded in parallel, with a stated substitute for those that cannot be had.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/load.h"
#include "scene/scene.h"

namespace luxel {

// Decoded texels that one scene may hold.
inline constexpr std::uint64_t max_texture_bytes = std::uint64_t(4) << 30;
// One image file.
inline constexpr std::uint64_t max_image_file_bytes = std::uint64_t(512) << 20;

// color: sRGB curve. The substitute is mid-grey; for a normal map it is the flat normal.
enum class TextureRole { color, data, normal };

struct TextureRequest {
    Texture texture; // all but the pixels
    TextureRole role = TextureRole::color;
    std::string image;                     // requests of the same image share one decoding
    std::string why_none = "has no image"; // said where there is no `read`
    // The file's bytes; nullopt: there is no such file. Called once per image, from any thread. What it
    // throws ends the load (a path that leaves the folder), unless it is Fault::io. Empty: the scene names no
    // readable image.
    std::function<std::optional<std::vector<std::uint8_t>>()> read;
};

struct LoadedTextures {
    std::vector<Texture> textures;
    // Counted sentences without the scene's name: what was substituted, and what decoders put up with.
    std::vector<std::string> warnings;
};
// A substitute is an error, Fault::bad_input, with options.strict.
LoadedTextures load_textures(std::vector<TextureRequest> requests, const std::string& scene_name,
                             const LoadOptions& options);

} // namespace luxel
