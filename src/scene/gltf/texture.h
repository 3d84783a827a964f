// SPDX-License-Identifier: MIT
// The textures that materials ask for.
#pragma once
#include <map>
#include <utility>

#include "scene/gltf/document.h"
#include "scene/load_texture.h"
#include "scene/scene.h"

namespace luxel::gltf {

// Hands out indices into Scene::textures. One glTF texture used both as color and as numbers becomes two.
class TextureTable {
public:
    explicit TextureTable(Document& document) : document_(document) {}

    // `info` is a textureInfo object; absent gives a use without a texture.
    TextureUse use(const Value& info, TextureRole role);

    // Reads and decodes everything that was asked for.
    std::vector<Texture> load(const LoadOptions& options);

private:
    TextureRequest request(std::size_t index, TextureRole role);

    Document& document_;
    std::map<std::pair<std::size_t, TextureRole>, int> known_;
    std::vector<TextureRequest> requests_;
};

} // namespace luxel::gltf
