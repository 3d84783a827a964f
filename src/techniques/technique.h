// SPDX-License-Identifier: MIT
// The contract of a real-time technique: one light-transport effect, from a frame to an image in radiance.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/parameters.h"
#include "gpu/recorder.h"
#include "scene/scene.h"
#include "shared/height_search.h"

namespace luxel {

struct Frame;

// Order of composition; two techniques for one slot is an error.
enum class Slot { surface, shadow, occlusion, diffuse, specular, caustics, media, post };
std::string_view slot_name(Slot slot);

struct Contribution {
    gpu::Image radiance;      // RGBA32F, frame size, added to the frame; rgb may be negative; may be empty
    gpu::Image accessibility; // R32F, frame size, multiplies the ambient term; may be empty (= 1)
};

class Technique {
public:
    virtual ~Technique() = default;
    virtual Slot slot() const = 0;
    virtual void visit(Visitor&) {}                  // knobs: see core/parameters.h
    virtual void prepare(gpu::Gpu&, const Scene&) {} // once per scene
    virtual Contribution render(gpu::Recorder& recorder, const Frame& frame) = 0; // once per frame

    // Slot::surface only: how height maps are searched while the frame, its shadow maps and every other
    // capture of the scene are drawn, before any render(). Without one they are not looked at.
    virtual std::optional<shared::HeightSearch> height_search() const { return std::nullopt; }

    // The renderer that has called prepare(); it expires with it.
    std::weak_ptr<const void> prepared_by;
};

struct TechniqueInfo {
    std::string name, summary;
    Slot slot;
    std::unique_ptr<Technique> (*make)();
};
const std::vector<TechniqueInfo>& all_techniques();

// Made and configured. Error Fault::usage: unknown name (the known are listed) or unknown parameter.
std::unique_ptr<Technique> make_technique(const Specification& specification);

} // namespace luxel
