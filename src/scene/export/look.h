// SPDX-License-Identifier: MIT
// A material as other renderers take it: constants, or pictures beside the scene file.
#pragma once
#include <string>

#include "scene/export/output.h"

namespace luxel {

// A constant, or a picture that holds the factor already.
struct Channel {
    glm::vec3 value{1.0f};
    std::string file; // empty: constant
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool nearest = false;
    float number() const { return value.x; }
};

struct Look {
    Channel color;              // base color, PNG of sRGB
    Channel metallic;           // PNG of numbers
    Channel alpha;              // GGX's alpha = roughness^2, PNG of numbers
    Channel emission;           // radiance, EXR
    Channel coverage;           // 1 where there is a surface, PNG of numbers; constant 1 for opaque ones
    Channel normal_map;         // EXR, its scale in it; no file: none
    Channel roughness;          // perceptual, PNG of numbers; where asked for
    float ior = 1.5f;           // of what the dielectric lobe reflects, `specular` in it
    bool reflects = true;       // has a dielectric lobe
    bool glass = false;         // light goes through
    glm::vec3 absorption{0.0f}; // of solid glass, per meter
};

// Writes the pictures of material `index`, and notes what neither pbrt nor Mitsuba has. Error Fault::io.
Look make_look(ExportOutput& out, std::size_t index, bool with_roughness);

} // namespace luxel
