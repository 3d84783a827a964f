// SPDX-License-Identifier: MIT
#include "experiments/picture_row.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "experiments/image_difference.h"
#include "experiments/picture_settings.h"
#include "experiments/view_choice.h"

namespace luxel {

namespace {

constexpr std::string_view prefix = "image:", placeholder = "{view}";

std::string pattern_of(const std::vector<ParameterInfo>& parameters) {
    const auto file = std::find_if(parameters.begin(), parameters.end(),
                                   [](const ParameterInfo& p) { return p.name == "file"; });
    LUXEL_ASSERT(file != parameters.end(), "parameters={}", parameters.size());
    return file->value;
}

} // namespace

bool is_picture_use(std::string_view text) { return text.starts_with(prefix); }

// A path may hold commas and signs: everything after the first "=" is one.
TechniqueRow parse_picture_use(std::string_view text) {
    const std::string_view rest = text.substr(prefix.size());
    const std::size_t equals = rest.find('=');
    if (equals == 0 || equals == rest.npos || equals + 1 == rest.size())
        fail(Fault::usage, "--image {}: expected NAME=FILE, of several views NAME=FILE with {{view}} in it",
             rest);
    TechniqueRow row;
    row.label = rest.substr(0, equals);
    row.name = picture_row_name;
    row.parameters = {
        {"file", "text", std::string(rest.substr(equals + 1)), "any text", "picture of the view"}};
    return row;
}

std::filesystem::path picture_file(const std::vector<ParameterInfo>& parameters, const std::string& view) {
    std::string file = pattern_of(parameters);
    const std::string name = file_name_of(view);
    for (std::size_t at = 0; (at = file.find(placeholder, at)) != file.npos; at += name.size())
        file.replace(at, placeholder.size(), name);
    return file;
}

void require_pictures(const TechniqueRow& row, const std::vector<Camera>& views) {
    const std::string pattern = pattern_of(row.parameters);
    if (views.size() > 1 && pattern.find(placeholder) == pattern.npos)
        fail(Fault::usage,
             "--image {}={}: it is one picture and there are {} views; write {{view}} where a view's name "
             "stands",
             row.label, pattern, views.size());
    for (const Camera& view : views)
        if (!std::filesystem::exists(picture_file(row.parameters, view.name)))
            fail(Fault::io, "{}: no such file, for --image {} of view '{}'",
                 picture_file(row.parameters, view.name).string(), row.label, view.name);
}

Image read_picture(const TechniqueRow& row, const Camera& camera, int width, int height,
                   std::vector<std::string>& warnings) {
    const std::filesystem::path file = picture_file(row.parameters, camera.name);
    ImageFile picture = read_image_file(file, "");
    const Image& image = picture.image;
    if (!picture.radiance)
        fail(Fault::bad_input,
             "{}: it holds display values; --image is measured as radiance, so write .exr or .hdr",
             file.string());
    if (image.width != width || image.height != height)
        fail(Fault::bad_input, "{}: it is {}x{} pixels where view '{}' is {}x{}; --size sets the view's",
             file.string(), image.width, image.height, camera.name, width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                if (!std::isfinite(image.rgb(x, y)[c]))
                    fail(Fault::bad_input, "{}: pixel ({}, {}) is not a finite number", file.string(), x, y);
    if (const std::optional<Camera> own = camera_of(picture.attributes)) {
        // A camera's name is the file's own matter.
        const Attributes view = {{attribute::camera, camera_text(camera)}};
        for (std::string& sentence : mismatches(file.string(), {{attribute::camera, camera_text(*own)}},
                                                fmt::format("view '{}'", camera.name), view, true))
            fail(Fault::bad_input, "{}", sentence);
    }
    warnings.insert(warnings.end(), picture.warnings.begin(), picture.warnings.end());
    const bool negative =
        std::any_of(image.data.begin(), image.data.end(), [](float value) { return value < 0.0f; });
    if (negative)
        warnings.push_back(file.string() + ": it has negative values, which are measured as they are");
    return std::move(picture.image);
}

} // namespace luxel
