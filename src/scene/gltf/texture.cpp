// SPDX-License-Identifier: MIT
#include "scene/gltf/texture.h"

#include <cmath>

#include "scene/gltf/uri.h"

namespace luxel::gltf {
namespace {

Wrap wrap_of(const Value& code) {
    switch (code.integer(10497)) {
    case 10497:
        return Wrap::repeat;
    case 33071:
        return Wrap::clamp;
    case 33648:
        return Wrap::mirror;
    default:
        code.fail("{} is not a wrap mode", code.integer());
    }
}

// KHR_texture_transform: scale, then rotate counter-clockwise as seen with v down, then offset.
glm::mat3 transform_of(const Value& extension) {
    const glm::vec2 offset = extension["offset"].vec<2>({0, 0}), scale = extension["scale"].vec<2>({1, 1});
    const float rotation = extension["rotation"].number(0.0f);
    const float c = std::cos(rotation), s = std::sin(rotation);
    return glm::mat3(c * scale.x, -s * scale.x, 0, s * scale.y, c * scale.y, 0, offset.x, offset.y, 1);
}

} // namespace

TextureUse TextureTable::use(const Value& info, TextureRole role) {
    TextureUse use;
    if (!info) return use;
    const std::size_t index = info["index"].index(document_.root()["textures"].size(), "texture");

    const Value transform = info["extensions"]["KHR_texture_transform"];
    use.transform = transform_of(transform);
    const Value set = transform["texCoord"] ? transform["texCoord"] : info["texCoord"];
    const std::uint64_t number = set.integer(0);
    if (number > 1) document_.warn("texture coordinates beyond the second set are replaced by the first");
    use.set = number == 1 ? 1 : 0;

    // The same texture in the same role is one entry.
    const auto [entry, added] = known_.emplace(std::pair(index, role), int(requests_.size()));
    if (added) requests_.push_back(request(index, role));
    use.texture = entry->second;
    return use;
}

TextureRequest TextureTable::request(std::size_t index, TextureRole role) {
    const Value root = document_.root(), texture = root["textures"].at(index);
    TextureRequest result;
    result.role = role;
    if (const Value sampler = texture["sampler"]) {
        const Value settings = document_.resolve("samplers", sampler);
        result.texture.wrap_u = wrap_of(settings["wrapS"]);
        result.texture.wrap_v = wrap_of(settings["wrapT"]);
        result.texture.nearest = settings["magFilter"].integer(9729) == 9728;
    }

    // Where a file has the image as WebP, too, that is the one to be read.
    const Value webp = texture["extensions"]["EXT_texture_webp"]["source"];
    const Value source = webp ? webp : texture["source"];
    if (!source) {
        result.image = fmt::format("textures[{}]", index);
        if (texture["extensions"]["KHR_texture_basisu"])
            result.why_none =
                "is KTX2 (KHR_texture_basisu), which is not read; convert it to PNG or WebP, as "
                "`ktx extract` and gltf-transform do";
        return result;
    }
    const Value image = document_.resolve("images", source);
    const Value uri = image["uri"];
    result.texture.name = printable(image["name"].text(""));
    if (uri) {
        result.image = fmt::format("{}: {}", image.place(), uri_name(uri.text()));
        result.read = [&folder = document_.folder(), uri] {
            return read_uri(folder, uri, max_image_file_bytes);
        };
    } else {
        result.image = image.place();
        const auto bytes = document_.buffer_view(image["bufferView"]).bytes;
        result.read = [bytes]() -> std::optional<std::vector<std::uint8_t>> {
            return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
        };
    }
    return result;
}

std::vector<Texture> TextureTable::load(const LoadOptions& options) {
    LoadedTextures loaded = load_textures(std::move(requests_), document_.name(), options);
    for (const std::string& warning : loaded.warnings) document_.warn(warning);
    return std::move(loaded.textures);
}

} // namespace luxel::gltf
