// SPDX-License-Identifier: MIT
// What several subcommands share: sizes, scenes with their warnings, frame options.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/image.h"
#include "experiments/experiment.h"
#include "experiments/output_folder.h"
#include "scene/load.h"

namespace luxel::app {

struct Size {
    int width = 640, height = 480;
};
// "WIDTHxHEIGHT", each 1 to max_image_side. Error Fault::usage.
Size parse_size(const std::string& text);

// --cameras FILE.toml.
CLI::Option* add_cameras_option(CLI::App& command, std::string& file);

// A finite number of 0 or above; CLI11's own check lets NaN pass.
CLI::Validator non_negative();

// --exposure of a .png.
CLI::Option* add_exposure_option(CLI::App& command, float& exposure);

// Where truths are kept.
struct CacheChoice {
    std::string folder;
    bool none = false;
    std::filesystem::path path() const; // empty = nowhere
};
void add_cache_options(CLI::App& command, CacheChoice& choice);

// "key=value,key=value" for --frame. Error Fault::usage.
std::vector<std::pair<std::string, std::string>> parse_values(const std::string& option,
                                                              const std::string& text);

void print_warnings(const std::vector<std::string>& warnings);

// What a run leaves behind: files in the folder, and the table or the JSON on stdout.
void finish_run(OutputFolder& output, const ExperimentResult& result, bool verbose, const Global& global);

// As the options that every subcommand takes have it.
LoadOptions load_options(const Global& global);

// Loaded under --strict, warnings printed.
Scene load(const std::string& source, const Global& global);

// Lines of cells: each column is two spaces wider than its widest cell, but the last cell of a line goes on
// as it is, so that a heading of one cell widens nothing.
std::string in_columns(const std::vector<std::vector<std::string>>& lines);

void print_json(const nlohmann::ordered_json& json);

// Writes by the file's ending: .exr as radiance, .png as display values under `exposure` (0: from the image
// itself). Error Fault::usage for another ending.
void write_picture(const std::string& file, const Layers& layers, const Image& picture, const Image& mask,
                   float exposure, const std::map<std::string, std::string>& metadata);
// The same check, before any work.
void check_picture_output(const std::string& file);

} // namespace luxel::app
