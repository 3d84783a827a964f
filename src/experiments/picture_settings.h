// SPDX-License-Identifier: MIT
// How a picture came to be, as attributes of its EXR file, so that two pictures that are held against each
// other later can be told to be of one view.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reference/reference.h"
#include "techniques/frame/frame.h"

namespace luxel {

using Attributes = std::map<std::string, std::string>;

// The names of those that diff looks at.
namespace attribute {
inline constexpr const char *version = "luxel.version", *scene = "luxel.scene",
                            *scene_key = "luxel.scene_key", *view = "luxel.view", *camera = "luxel.camera",
                            *sampling = "luxel.sampling", *environment = "luxel.environment",
                            *component = "luxel.component", *spp = "luxel.spp", *seed = "luxel.seed",
                            *settings = "luxel.settings", *frame = "luxel.frame", *use = "luxel.use";
}

// `scene` as it was loaded from `source`. frame: what the light is taken by; null: the true environment.
Attributes attributes_of(const Scene& scene, const std::string& source, const Camera& camera,
                         const FrameOptions* frame);
void add_reference(Attributes& attributes, const std::string& component, const ReferenceSettings& settings,
                   int spp);
void add_frame(Attributes& attributes, const std::string& use, const FrameOptions& frame);

// As JSON, all fields.
std::string camera_text(const Camera& camera);
std::optional<Camera> camera_of(const Attributes& attributes); // nothing without a sound one

// "center" or "area".
std::string sampling_of(bool pixel_center);
std::string sampling_of(const FrameOptions& frame);

// One sentence for each way in which two pictures are not of the same: scene, camera, sampling, environment,
// and light paths (for layers without a name). What a file does not say is not held against it.
std::vector<std::string> mismatches(const std::string& a_name, const Attributes& a, const std::string& b_name,
                                    const Attributes& b, bool named_layer);

} // namespace luxel
