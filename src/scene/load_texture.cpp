// SPDX-License-Identifier: MIT
#include "scene/load_texture.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <thread>

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

// The file's bytes, or none and what went wrong. Running out of a resource is an error all the same.
std::optional<std::vector<std::uint8_t>> read(const TextureRequest& request, std::string& problem) {
    std::optional<std::vector<std::uint8_t>> bytes;
    if (!request.read) {
        problem = request.image + ": " + request.why_none;
        return bytes;
    }
    try {
        bytes = request.read();
        if (!bytes) problem = request.image + ": no such file";
    } catch (const Error& error) {
        if (error.fault() != Fault::io && error.fault() != Fault::bad_input) throw;
        problem = error.what();
    }
    return bytes;
}

// Reads and decodes images [first, end) of all.
void decode(std::vector<DecodedImage>& images, std::size_t first, std::size_t end) {
    std::vector<std::vector<std::uint8_t>> files;
    std::vector<std::size_t> which;
    for (std::size_t i = first; i < end; ++i)
        if (auto bytes = read(*images[i].request, images[i].problem)) {
            files.push_back(std::move(*bytes));
            which.push_back(i);
        }
    std::vector<EncodedImage> encoded;
    for (std::size_t k = 0; k < files.size(); ++k)
        encoded.push_back({files[k], images[which[k]].request->image});
    std::vector<std::variant<Pixels, Error>> decoded = decode_pixels(encoded);
    for (std::size_t k = 0; k < which.size(); ++k) {
        DecodedImage& image = images[which[k]];
        if (Pixels* pixels = std::get_if<Pixels>(&decoded[k])) {
            image.pixels = std::move(*pixels);
        } else {
            const Error& error = std::get<Error>(decoded[k]);
            if (error.fault() != Fault::bad_input) throw error;
            image.problem = error.what();
        }
    }
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
    // Several by one task share a process, but not so many that processors are idle.
    const std::size_t together =
        std::clamp<std::size_t>(images.size() / (4 * std::thread::hardware_concurrency() + 1), 1, 16);
    parallel_for((images.size() + together - 1) / together, 1, [&](std::size_t i) {
        const std::size_t first = i * together, end = std::min(first + together, images.size());
        decode(images, first, end);
        for (std::size_t k = first; k < end; ++k) budget.charge(images[k].pixels);
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
