// SPDX-License-Identifier: MIT
#include "options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "core/error.h"
#include "core/image_io.h"
#include "core/parameters.h"
#include "experiments/json_text.h"
#include "experiments/output_folder.h"
#include "experiments/reference_cache.h"
#include "experiments/result_files.h"
#include "experiments/results_json.h"
#include "experiments/table.h"

namespace luxel::app {

namespace {

// A scene may have a warning per material; beyond this many they are only counted.
constexpr std::size_t printed_warnings = 20;

int parse_side(std::string_view text, std::string_view whole) {
    int side = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), side);
    if (error != std::errc{} || end != text.data() + text.size() || side < 1 || side > max_image_side)
        fail(Fault::usage, "--size {}: expected WIDTHxHEIGHT, each from 1 to {}", whole, max_image_side);
    return side;
}

// CLI11 has checked that it is there.
std::size_t place(const std::vector<std::string>& names, const std::string& name) {
    return std::size_t(std::find(names.begin(), names.end(), name) - names.begin());
}

std::string ending_of(const std::string& file) { return std::filesystem::path(file).extension().string(); }

} // namespace

Size parse_size(const std::string& text) {
    const std::size_t cross = std::min(text.find('x'), text.size());
    const std::string_view view = text;
    return {parse_side(view.substr(0, cross), text),
            parse_side(view.substr(std::min(cross + 1, text.size())), text)};
}

std::vector<std::pair<std::string, std::string>> parse_values(const std::string& option,
                                                              const std::string& text) {
    return text.empty() ? decltype(Specification::values){} : parse_specification(option + ":" + text).values;
}

CLI::Option* add_cameras_option(CLI::App& command, std::string& file) {
    return command.add_option("--cameras", file,
                              "Camera script, TOML, instead of the scene's cameras; see luxel views");
}

CLI::Validator non_negative() {
    // Written so that NaN is refused.
    const auto check = [](const std::string& text) {
        float value = -1.0f;
        const bool read = CLI::detail::lexical_cast(text, value);
        return read && value >= 0.0f && std::isfinite(value) ? std::string()
                                                             : text + " is no finite number of 0 or above";
    };
    return CLI::Validator(check, "FLOAT:NONNEGATIVE", "non_negative");
}

CLI::Option* add_exposure_option(CLI::App& command, float& exposure) {
    return command.add_option("--exposure", exposure, "For .png; 0 = 98th percentile to white")
        ->check(non_negative());
}

std::filesystem::path CacheChoice::path() const {
    if (none) return {};
    return folder.empty() ? default_cache_folder() : std::filesystem::path(folder);
}

void add_cache_options(CLI::App& command, CacheChoice& choice) {
    command.add_option("--cache", choice.folder,
                       "Folder of stored truths; default: $XDG_CACHE_HOME/luxel or ~/.cache/luxel");
    command.add_flag("--no-cache", choice.none, "Neither read nor store truths");
}

void print_warnings(const std::vector<std::string>& warnings) {
    const std::size_t shown = std::min(warnings.size(), printed_warnings);
    for (std::size_t i = 0; i < shown; ++i) fmt::print(stderr, "luxel: warning: {}\n", warnings[i]);
    if (warnings.size() > 1) fmt::print(stderr, "luxel: warning: {} warnings in all\n", warnings.size());
}

void finish_run(OutputFolder& output, const ExperimentResult& result, bool verbose, const Global& global) {
    write_results(output.path(), result);
    output.keep();
    if (global.json) return print_json(to_json(result));
    fmt::print("{}\nReport: {}\n", format_result(result, verbose), (output.path() / "report.html").string());
    std::fflush(stdout);
}

LoadOptions load_options(const Global& global) {
    return {.strict = global.strict,
            .environment = global.environment,
            .environment_scale = global.environment_scale,
            .data = global.data,
            .brdf = global.single_scattering ? BrdfModel::single : BrdfModel::multiple,
            .single_sided = SingleSided(place(single_sided_names, global.single_sided)),
            .lights = LightUnits(place(light_units_names, global.lights))};
}

Scene load(const std::string& source, const Global& global) {
    Scene scene = load_scene(source, load_options(global));
    print_warnings(scene.warnings);
    return scene;
}

std::string in_columns(const std::vector<std::vector<std::string>>& lines) {
    std::vector<std::size_t> widths;
    for (const auto& line : lines) {
        widths.resize(std::max(widths.size(), line.size()));
        for (std::size_t i = 0; i + 1 < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
    }
    std::string text;
    for (const auto& line : lines) {
        std::string row;
        for (std::size_t i = 0; i < line.size(); ++i)
            row += i + 1 < line.size() ? fmt::format("{:<{}}", line[i], widths[i] + 2) : line[i];
        text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

void print_json(const nlohmann::ordered_json& json) { fmt::print("{}\n", dump(json)); }

void check_picture_output(const std::string& file) {
    if (ending_of(file) != ".exr" && ending_of(file) != ".png")
        fail(Fault::usage, "{}: output: expected a name that ends in .exr or .png", file);
    check_writable(file);
}

void write_picture(const std::string& file, const Layers& layers, const Image& picture, const Image& mask,
                   float exposure, const std::map<std::string, std::string>& metadata) {
    if (ending_of(file) == ".exr") return write_exr(file, layers, metadata);
    write_png(file, display(picture, exposure > 0 ? exposure : exposure_of(picture, mask)));
}

} // namespace luxel::app
