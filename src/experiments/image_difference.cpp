// SPDX-License-Identifier: MIT
#include "experiments/image_difference.h"

#include <algorithm>
#include <cmath>

#include <fmt/ranges.h>

#include "core/error.h"
#include "core/file.h"
#include "core/image_io.h"
#include "core/metrics.h"
#include "experiments/components.h"
#include "reference/estimate_io.h"

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

Image one_channel(const Image& image) {
    Image out(image.width, image.height, 1);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) *out.at(x, y) = *image.at(x, y);
    return out;
}

Image last_channel(const Image& image) {
    Image alpha(image.width, image.height, 1);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) *alpha.at(x, y) = image.at(x, y)[image.channels - 1];
    return alpha;
}

// The groups of samples of a layer: its own, or for the unnamed one those of the light paths that it is the
// sum of.
std::array<Image, sample_groups> groups_of(const ExrFile& exr, const std::string& layer) {
    std::vector<std::string> components = {layer};
    const auto named = exr.metadata.find(attribute::component);
    if (layer.empty() && !exr.layers.contains(group_layer("", 0)) && named != exr.metadata.end()) try {
            components = parse_components(named->second);
        } catch (const Error&) {
            return {}; // of another program
        }
    std::array<Image, sample_groups> groups;
    for (int g = 0; g < sample_groups; ++g) {
        Layers parts;
        for (const std::string& component : components) {
            const auto part = exr.layers.find(group_layer(component, g));
            if (part == exr.layers.end()) return {};
            parts[component] = part->second;
        }
        groups[std::size_t(g)] = sum_of(parts, components);
    }
    return groups;
}

ImageFile read_layer(const std::filesystem::path& file, const std::string& layer) {
    ExrFile exr = read_exr(file);
    ImageFile out{.radiance = true};
    if (!exr.remark.empty()) out.warnings.push_back(file.string() + ": " + exr.remark);
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
    if (found->second.channels == 4) out.alpha = last_channel(found->second);
    const auto component = exr.metadata.find(attribute::component);
    out.accessibility = found->second.channels == 1 &&
                        (found->first == "ao" ||
                         (layer.empty() && component != exr.metadata.end() && component->second == "ao"));
    const auto fitted = [&](const Image& image) {
        return out.accessibility ? one_channel(image) : three_channels(image);
    };
    out.image = fitted(found->second);
    out.groups = groups_of(exr, found->first);
    for (Image& group : out.groups)
        if (!group.empty()) group = fitted(group);
    out.attributes = std::move(exr.metadata);
    return out;
}

Image display_values(const Pixels& pixels) {
    Image image(pixels.width, pixels.height, 3);
    for (std::size_t i = 0; i < image.pixels(); ++i)
        for (std::size_t c = 0; c < 3; ++c) image.data[3 * i + c] = pixels.value(4 * i + c);
    return image;
}

Image alpha_values(const Pixels& pixels) {
    Image alpha(pixels.width, pixels.height, 1);
    for (std::size_t i = 0; i < alpha.pixels(); ++i) alpha.data[i] = pixels.value(4 * i + 3);
    return alpha;
}

// A file with its name, for sentences.
struct Named {
    ImageFile file;
    std::string name;
};

void require_alike(const Named& a, const Named& b) {
    if (a.file.radiance != b.file.radiance)
        fail(Fault::bad_input, "{}: kind: it holds {}, {} {}", b.name,
             b.file.radiance ? "radiance" : "display values", a.name,
             a.file.radiance ? "radiance" : "display values");
    if (a.file.image.width != b.file.image.width || a.file.image.height != b.file.image.height)
        fail(Fault::bad_input, "{}: size: {}x{} pixels, {} has {}x{}", b.name, b.file.image.width,
             b.file.image.height, a.name, a.file.image.width, a.file.image.height);
}

bool is_finite(const Image& image, int x, int y) {
    const float* p = image.at(x, y);
    return std::all_of(p, p + image.channels, [](float v) { return std::isfinite(v); });
}

// Pixels that count and are not finite in one of the pictures.
std::size_t not_finite(const std::vector<const Named*>& files, const Image& mask) {
    std::size_t count = 0;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            count += *mask.at(x, y) > 0.0f &&
                     !std::all_of(files.begin(), files.end(),
                                  [&](const Named* file) { return is_finite(file->file.image, x, y); });
    return count;
}

AlphaDifference alpha_difference(const Image& a, const Image& b) {
    AlphaDifference out;
    const std::size_t pixels = std::max(a.data.size(), b.data.size());
    for (std::size_t i = 0; i < pixels; ++i) {
        const double of_a = a.empty() ? 1.0 : double(a.data[i]), of_b = b.empty() ? 1.0 : double(b.data[i]);
        if (of_a == of_b) continue;
        ++out.differing;
        out.delta += std::abs(of_a - of_b) / double(pixels);
    }
    return out;
}

// In single precision, which over a million pixels is off by up to .4 %: for comparison with published
// figures.
double single_precision_mean(const Image& map, const Image& mask) {
    const std::vector<float> errors = inside(map, mask);
    float sum = 0.0f;
    for (float error : errors) sum += error;
    return errors.empty() ? 0.0 : double(sum / float(errors.size()));
}

// The truth of the reference's file as evaluation has it; display values have neither exposure nor noise. Its
// groups tell its noise, as long as what it is held against has none of its own.
Target target_of(const ImageFile& truth, const Image& mask, bool with_groups) {
    Target target;
    if (!truth.radiance) {
        target.radiance = target.shown = truth.image;
        target.mask = mask;
        return target;
    }
    const std::string component = truth.accessibility ? "ao" : "";
    Truth estimate;
    estimate.mask = truth.mask;
    estimate.mean[component] = truth.image;
    for (std::size_t g = 0; with_groups && g < truth.groups.size(); ++g)
        if (!truth.groups[g].empty()) estimate.group[g][component] = truth.groups[g];
    return make_target(estimate, {component}, mask);
}

Candidate candidate_of(const Target& target, const ImageFile& reference, const ImageFile& file) {
    if (!file.radiance) return {file.image, file.image};
    return make_candidate(target, reference.accessibility ? one_channel(file.image) : file.image);
}

std::string remark_on_not_finite(const Difference& d, const std::vector<const Named*>& files,
                                 const Image& mask) {
    std::vector<std::string> shares;
    for (const Named* file : files)
        if (const std::size_t count = not_finite({file}, mask); count > 0)
            shares.push_back(fmt::format("{} in {}", count, file->name));
    return fmt::format(
        "{} of {} pixels that count are NaN or infinite ({}): display values take NaN as black, infinity as "
        "white; rmse and relmse are not finite",
        d.not_finite, d.counted, fmt::join(shares, ", "));
}

// What the figures do not say.
std::vector<std::string> remarks(const Difference& d, const std::vector<const Named*>& files,
                                 const Image& mask, const std::string& layer) {
    const Named& reference = *files[0];
    std::vector<std::string> sentences;
    for (std::size_t i = 1; i < files.size(); ++i) {
        const auto of_pair = mismatches(reference.name, reference.file.attributes, files[i]->name,
                                        files[i]->file.attributes, !layer.empty());
        sentences.insert(sentences.end(), of_pair.begin(), of_pair.end());
        if (!files[i]->file.groups[0].empty())
            sentences.push_back(
                fmt::format("{} is an estimate, too: the noise of both counts as error", files[i]->name));
    }
    for (const Named* file : files)
        sentences.insert(sentences.end(), file->file.warnings.begin(), file->file.warnings.end());
    if (reference.file.attributes.contains(attribute::spp) && reference.file.groups[0].empty())
        sentences.push_back(fmt::format("{} holds no groups of samples: what its noise adds is not taken out",
                                        reference.name));
    if (d.counted == 0) sentences.push_back("no pixel counts: the masks leave all of them out");
    if (d.not_finite > 0) sentences.push_back(remark_on_not_finite(d, files, mask));
    if (d.alpha.differing > 0)
        sentences.push_back(
            fmt::format("{} and {} differ in the alpha of {} of {} pixels, by {:.4g} on average; the figures "
                        "of color do not count it",
                        reference.name, files[1]->name, d.alpha.differing, d.pixels, d.alpha.delta));
    return sentences;
}

} // namespace

ImageFile read_image_file(const std::filesystem::path& file, const std::string& layer) {
    const std::vector<std::uint8_t> bytes = read_file(file, largest_image_file);
    ImageFile out;
    if (begins_with(bytes, "\x76\x2f\x31\x01"))
        out = read_layer(file, layer);
    else if (begins_with(bytes, "#?")) {
        out.image = three_channels(decode_hdr(bytes, file.string(), &out.warnings));
        out.radiance = true;
    } else {
        const Pixels pixels = decode_pixels(bytes, file.string());
        out.image = display_values(pixels);
        if (pixels.has_alpha) out.alpha = alpha_values(pixels);
        if (!pixels.remark.empty()) out.warnings.push_back(file.string() + ": " + pixels.remark);
    }
    if (out.mask.empty()) out.mask = Image(out.image.width, out.image.height, 1, 1.0f);
    return out;
}

Difference difference(const std::filesystem::path& reference, const std::filesystem::path& image,
                      const std::optional<std::filesystem::path>& baseline, const std::string& layer) {
    const auto read = [&](const std::filesystem::path& file) {
        return Named{read_image_file(file, layer), file.string()};
    };
    const Named truth = read(reference), other = read(image);
    const std::optional<Named> base = baseline ? std::optional(read(*baseline)) : std::nullopt;
    std::vector<const Named*> files = {&truth, &other};
    if (base) files.push_back(&*base);

    // Pixels count that count in every picture.
    Image mask = truth.file.mask;
    for (const Named* file : files) {
        require_alike(truth, *file);
        for (std::size_t i = 0; i < mask.data.size(); ++i)
            mask.data[i] = mask.data[i] > 0.0f && file->file.mask.data[i] > 0.0f ? 1.0f : 0.0f;
    }

    const bool exact = std::none_of(files.begin() + 1, files.end(),
                                    [](const Named* file) { return !file->file.groups[0].empty(); });
    const Target target = target_of(truth.file, mask, exact);
    const Candidate candidate = candidate_of(target, truth.file, other.file);
    Difference out;
    out.exposure = target.exposure;
    if (!target.quarters.empty()) out.noise = target.noise;
    out.figures = measure(target, base ? candidate_of(target, truth.file, base->file) : candidate, candidate);
    out.flip = flip_ldr(target.shown, candidate.shown, mask);
    out.evaluator_flip = single_precision_mean(out.flip.map, mask);
    if (truth.file.radiance && !truth.file.accessibility) {
        out.flip_hdr = flip_hdr(target.radiance, candidate.radiance, mask);
        out.evaluator_flip_hdr = single_precision_mean(out.flip_hdr->map, mask);
    }
    out.pixels = mask.pixels();
    out.counted = std::size_t(std::count(mask.data.begin(), mask.data.end(), 1.0f));
    out.not_finite = not_finite(files, mask);
    out.alpha = alpha_difference(truth.file.alpha, other.file.alpha);
    out.picture = difference_picture(target.shown, candidate.shown);
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            if (*mask.at(x, y) <= 0.0f) out.picture.set_rgb(x, y, glm::vec3(1.0f));
    out.warnings = remarks(out, files, mask, layer);
    return out;
}

} // namespace luxel
