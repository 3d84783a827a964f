// SPDX-License-Identifier: MIT
#include "experiments/image_difference.h"

#include <algorithm>

#include <fmt/ranges.h>

#include "core/error.h"
#include "core/file.h"
#include "core/image_io.h"
#include "core/metrics.h"

namespace luxel {

namespace {

constexpr std::uint64_t largest_image_file = std::uint64_t(2) << 30;

bool begins_with(const std::vector<std::uint8_t>& bytes, std::string_view magic) {
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(),
                      [](char a, std::uint8_t b) { return std::uint8_t(a) == b; });
}

Image three_channels(const Image& image) {
    if (image.channels == 3) return image;
    Image out(image.width, image.height, 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) out.set_rgb(x, y, image.rgb(x, y));
    return out;
}

ImageFile read_layer(const std::filesystem::path& file, const std::string& layer) {
    ExrFile exr = read_exr(file);
    ImageFile out{.radiance = true};
    const auto mask = exr.layers.find("mask");
    if (mask != exr.layers.end() && layer != "mask" && mask->second.channels == 1) {
        out.mask = std::move(mask->second);
        exr.layers.erase(mask);
    }
    auto found = exr.layers.find(layer);
    if (found == exr.layers.end() && layer.empty() && exr.layers.size() == 1) found = exr.layers.begin();
    if (found == exr.layers.end()) {
        std::vector<std::string> known;
        for (const auto& [name, image] : exr.layers) known.push_back(name.empty() ? "(unnamed)" : name);
        fail(Fault::usage, "{}: layer '{}': there is none; known: {}", file.string(), layer,
             fmt::join(known, ", "));
    }
    out.image = three_channels(found->second);
    return out;
}

Image display_values(const Pixels8& pixels) {
    Image image(pixels.width, pixels.height, 3);
    for (std::size_t i = 0; i < image.pixels(); ++i)
        for (std::size_t c = 0; c < 3; ++c) image.data[3 * i + c] = float(pixels.rgba[4 * i + c]) / 255.0f;
    return image;
}

void require_alike(const ImageFile& a, const std::filesystem::path& a_name, const ImageFile& b,
                   const std::filesystem::path& b_name) {
    if (a.radiance != b.radiance)
        fail(Fault::bad_input, "{}: kind: it holds {}, {} {}", b_name.string(),
             b.radiance ? "radiance" : "display values", a_name.string(),
             a.radiance ? "radiance" : "display values");
    if (a.image.width != b.image.width || a.image.height != b.image.height)
        fail(Fault::bad_input, "{}: size: {}x{} pixels, {} has {}x{}", b_name.string(), b.image.width,
             b.image.height, a_name.string(), a.image.width, a.image.height);
}

// In single precision, which over a million pixels is off by up to .4 %: for comparison with published
// figures.
double single_precision_mean(const Image& map) {
    float sum = 0.0f;
    for (float error : map.data) sum += error;
    return double(sum / float(map.data.size()));
}

Candidate candidate_of(const Target& target, ImageFile file) {
    if (file.radiance) return make_candidate(target, std::move(file.image));
    return {file.image, file.image};
}

} // namespace

ImageFile read_image_file(const std::filesystem::path& file, const std::string& layer) {
    const std::vector<std::uint8_t> bytes = read_file(file, largest_image_file);
    ImageFile out;
    if (begins_with(bytes, "\x76\x2f\x31\x01"))
        out = read_layer(file, layer);
    else if (begins_with(bytes, "#?"))
        out = {.image = three_channels(decode_hdr(bytes, file.string())), .radiance = true};
    else
        out.image = display_values(decode_pixels(bytes, file.string()));
    if (out.mask.empty()) out.mask = Image(out.image.width, out.image.height, 1, 1.0f);
    return out;
}

Difference difference(const std::filesystem::path& reference, const std::filesystem::path& image,
                      const std::optional<std::filesystem::path>& baseline, const std::string& layer) {
    ImageFile truth = read_image_file(reference, layer);
    ImageFile other = read_image_file(image, layer);
    require_alike(truth, reference, other, image);

    Target target;
    target.mask = std::move(truth.mask);
    target.exposure = truth.radiance ? exposure_of(truth.image, target.mask) : 1.0f;
    target.shown = truth.radiance ? display(truth.image, target.exposure) : truth.image;
    target.radiance = std::move(truth.image);

    Difference out;
    out.exposure = target.exposure;
    const Candidate candidate = candidate_of(target, std::move(other));
    if (baseline) {
        ImageFile base = read_image_file(*baseline, layer);
        require_alike({.image = target.radiance, .radiance = truth.radiance}, reference, base, *baseline);
        out.figures = measure(target, candidate_of(target, std::move(base)), candidate);
    } else
        out.figures = measure(target, candidate, candidate);

    out.flip = flip_ldr(target.shown, candidate.shown);
    if (truth.radiance) out.flip_hdr = flip_hdr(target.radiance, candidate.radiance);
    out.evaluator_flip = single_precision_mean(out.flip.map);
    if (out.flip_hdr) out.evaluator_flip_hdr = single_precision_mean(out.flip_hdr->map);
    out.picture = difference_picture(target.shown, candidate.shown);
    return out;
}

} // namespace luxel
