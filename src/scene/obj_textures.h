// SPDX-License-Identifier: MIT
// The textures of MTL materials: as the file names them, and such as several of
// its maps make together.
#pragma once
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "core/file.h"
#include "scene/load_texture.h"
#include "scene/scene.h"

namespace tinyobj {
struct texture_option_t;
}

namespace luxel {

class ObjTextures {
public:
    explicit ObjTextures(const Folder& folder) : folder_(folder) {}

    // One texture per file and role; an empty name is none.
    TextureUse use(const std::string& file, const tinyobj::texture_option_t& options, TextureRole role);

    // A map of numbers, in one channel of a file.
    struct Numbers {
        TextureUse use;
        char channel = 'l'; // r, g, b, a (alpha); any other, as the parser's default m, is luminance
        explicit operator bool() const { return use.texture >= 0; }
    };
    Numbers numbers(const std::string& file, const tinyobj::texture_option_t& options);

    // Textures that finish() makes out of others, for a slot of a material.
    void combine_metallic_roughness(std::size_t material, const Numbers& metallic, const Numbers& roughness);
    void combine_alpha(std::size_t material,
                       const Numbers& alpha); // with its base color texture
    void make_normals(std::size_t material, const Numbers& heights, float scale);

    // Loads all textures, makes the combined ones and keeps what materials use.
    void finish(Scene& scene, const std::string& source, const LoadOptions& options);

private:
    enum class Kind { metallic_roughness, alpha, normals };
    struct Combination {
        Kind kind;
        std::size_t material;
        Numbers first, second;
        float scale = 1.0f;
    };
    Texture combine(const std::vector<Texture>& textures, const Combination& c, Material& material,
                    std::vector<std::string>& notes) const;

    const Folder& folder_;
    std::map<std::tuple<std::string, TextureRole, bool>, int> known_;
    std::vector<TextureRequest> requests_;
    std::vector<Combination> combinations_;
};

// Heights in [0, 1] as a normal map: slopes are `scale` times the difference
// from texel to texel.
Texture normals_of_heights(const Texture& heights, char channel, float scale);

} // namespace luxel
