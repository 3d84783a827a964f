// SPDX-License-Identifier: MIT
// A row that is no technique: a picture of the same view that another renderer made.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"
#include "experiments/technique_rows.h"
#include "scene/scene.h"

namespace luxel {

inline constexpr std::string_view picture_row_name = "image";

// "image:NAME=FILE" follows --use; {view} in FILE stands for a view's name, as images/ has it. Error
// Fault::usage: no name or no file.
bool is_picture_use(std::string_view text);
TechniqueRow parse_picture_use(std::string_view text);

inline bool is_picture(const TechniqueRow& row) { return row.name == picture_row_name; }

// The row's file for a view.
std::filesystem::path picture_file(const std::vector<ParameterInfo>& parameters, const std::string& view);

// Before any work: a file for each view. Error Fault::usage: one for several; Fault::io: no such file.
void require_pictures(const TechniqueRow& row, const std::vector<Camera>& views);

// Radiance of the view, three channels; `warnings` takes what is odd about it. Error Fault::bad_input:
// display values, another size, a value that is not finite, another camera; Fault::io.
Image read_picture(const TechniqueRow& row, const Camera& camera, int width, int height,
                   std::vector<std::string>& warnings);

} // namespace luxel
