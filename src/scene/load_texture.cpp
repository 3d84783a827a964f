// SPDX-License-Identifier: MIT
#include "scene/load_texture.h"

#include <algorithm>
#include <atomic>
#include <map>

#include "core/error.h"
#include "core/parallel.h"

namespace luxel {
namespace {

// One image file and what became of it.
struct DecodedImage {
    const TextureRequest* request = nullptr;
    Pixels pixels;
    std::string problem; // empty: decoded
    int uses = 0;        // requests still to be served
};

Pixels substitute(TextureRole role) {
    Pixels pixels;
    pixels.width = pixels.height = 1;
    pixels.rgba = {128, 128, std::uint8_t(role == TextureRole::normal ? 255 : 128), 255};
    return pixels;
}

// What went wrong with reading or decoding, or an empty text. Running out of a resource is an error all the
// same.
std::string decode(const TextureRequest& request, Pixels& pixels) {
    if (!request.read) return request.image + ": has no PNG or JPEG image";
    std::optional<std::vector<std::uint8_t>> bytes;
    try {
        bytes = request.read();
    } catch (const Error& error) {
        if (error.fault() != Fault::io && error.fault() != Fault::bad_input) throw;
        return error.what();
    }
    if (!bytes) return request.image + ": no such file";
    try {
        pixels = decode_pixels(*bytes, request.image);
    } catch (const Error& error) {
        if (error.fault() != Fault::bad_input) throw;
        return error.what();
    }
    return {};
}

// Texels are added up as they come: the sizes are known only to the decoder.
class TexelBudget {
public:
    explicit TexelBudget(const std::string& scene_name) : scene_name_(scene_name) {}
    void charge(const Pixels& pixels) {
        if ((taken_ += pixels.bytes()) > max_texture_bytes)
            fail(Fault::resource, "{}: its textures need more than {} GiB", scene_name_,
                 max_texture_bytes >> 30);
    }

private:
    const std::string& scene_name_;
    std::atomic<std::uint64_t> taken_ = 0;
};

// One counted sentence about those images of which `text` is not empty, or none.
template <class Text> void describe(const std::vector<DecodedImage>& images, const char* what, Text&& text,
                                    std::vector<std::string>& out) {
    const auto is_one = [&](const DecodedImage& image) { return !text(image).empty(); };
    const auto count = std::count_if(images.begin(), images.end(), is_one);
    if (count == 0) return;
    out.push_back(fmt::format("{} texture image{} {}, first: {}", count, count == 1 ? "" : "s", what,
                              text(*std::find_if(images.begin(), images.end(), is_one))));
}

} // namespace

LoadedTextures load_textures(std::vector<TextureRequest> requests, const std::string& scene_name,
                             const LoadOptions& options) {
    // Each image once, in a fixed order: the first problem reported does not depend on the threads.
    std::map<std::string, std::size_t> index_of;
    std::vector<DecodedImage> images;
    for (const TextureRequest& request : requests)
        if (index_of.emplace(request.image, images.size()).second) images.push_back({&request, {}, {}, 0});
    TexelBudget budget(scene_name);
    parallel_for(images.size(), 1, [&](std::size_t i) {
        images[i].problem = decode(*images[i].request, images[i].pixels);
        budget.charge(images[i].pixels);
    });

    LoadedTextures result;
    describe(
        images, "replaced by grey", [](const DecodedImage& image) { return image.problem; }, result.warnings);
    if (options.strict && !result.warnings.empty())
        fail(Fault::bad_input, "{}: {}", scene_name, result.warnings.front());
    const auto remark_of = [](const DecodedImage& image) {
        const std::string& remark = image.pixels.remark;
        return remark.empty() ? remark : image.request->image + ": " + remark;
    };
    describe(images, "with a flaw", remark_of, result.warnings);

    // The last request of an image takes its pixels, the others copies.
    for (const TextureRequest& request : requests) ++images[index_of[request.image]].uses;
    for (TextureRequest& request : requests) {
        DecodedImage& image = images[index_of[request.image]];
        Texture texture = std::move(request.texture);
        texture.srgb = request.role == TextureRole::color;
        if (!image.problem.empty()) {
            texture.pixels = substitute(request.role);
        } else if (--image.uses == 0) {
            texture.pixels = std::move(image.pixels);
        } else {
            budget.charge(image.pixels);
            texture.pixels = image.pixels;
        }
        result.textures.push_back(std::move(texture));
    }
    return result;
}

} // namespace luxel
