// SPDX-License-Identifier: MIT
// Any scene source to a Scene: "builtin:NAME", .gltf, .glb, .obj, .toml (wraps geometry, see
// docs/scene-file.md).
#pragma once
#include <string>
#include <vector>

#include "scene/scene.h"

namespace luxel {

// Whether cameras look through the backs of what glTF files have as single-sided, see Material::backs_unseen.
// (OBJ files say nothing of sides.)
enum class SingleSided { cull, opaque };
inline const std::vector<std::string> single_sided_names = {"cull", "opaque"};

// What the intensities of punctual lights in files are: photometric as the format has it (candela, lux);
// lumens made of watts by 683 lumens each, while emissive surfaces and skies keep their watts; or the power
// of the whole lamp in watts (a sun's in watts per square meter).
enum class LightUnits { photometric, watts, power };
inline const std::vector<std::string> light_units_names = {"photometric", "watts", "power"};

struct LoadOptions {
    bool strict = false; // a substitute (missing texture) is an error instead of a warning
    // Replaces the scene's environment when not empty: "sky" (the default gradient) or an equirectangular
    // .hdr, .exr, .png or .jpg file.
    std::string environment;
    float environment_scale = 1.0f; // factor on that environment
    // The folder of what scene files name as "data:PATH"; empty = none.
    std::string data;
    BrdfModel brdf = BrdfModel::multiple;
    SingleSided single_sided = SingleSided::cull;
    LightUnits lights = LightUnits::photometric;
};

// Validated: every index in range, every number finite, at least one triangle, at least one camera and at
// least one source of light (stated defaults are added with a warning). Errors: Fault::bad_input, Fault::io.
Scene load_scene(const std::string& source, const LoadOptions& options = {});

// One file, or one built-in scene, as it is: no defaults added, no scene file. Same errors.
Scene load_geometry(const std::string& source, const LoadOptions& options = {});

// Names accepted after "builtin:", with one line each.
struct BuiltinScene {
    std::string name, meaning;
};
std::vector<BuiltinScene> builtin_scenes();
// With times and numbers of triangles, too, which the list has examples of only.
bool is_builtin_scene(const std::string& name);

} // namespace luxel
