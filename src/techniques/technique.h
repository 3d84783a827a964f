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

struct Capture;
struct Frame;
struct FrameOptions;

// Order of rendering and composition. Two techniques for one slot is an error, unless they have different
// receivers.
enum class Slot { surface, shadow, occlusion, diffuse, caustics, specular, media, post };
std::string_view slot_name(Slot slot);

// Which surfaces a technique lights: all, or those of objects whose role begins with "dynamic"
// (scene/roles.h). In a slot that has one of each, the former leaves the latter's surfaces to it.
enum class Receivers { all, dynamic_objects };

struct Contribution {
    gpu::Image radiance;      // RGBA32F, frame size, added to the frame; rgb may be negative; may be empty
    gpu::Image accessibility; // R32F, frame size, multiplies the ambient term; may be empty (= 1)
    bool from_afar = false;   // the accessibility of the occlusion slot multiplies `radiance`, too
};

// A condition without which a technique changes no pixel.
struct Need {
    std::string what; // "a mirror or glass"
    bool met;
};

class Technique {
public:
    virtual ~Technique() = default;
    virtual Slot slot() const = 0;

    // What it computes, by the reference's names of light paths: the truth that it can reach is direct light
    // plus these. "ao" where it delivers an accessibility; "direct" where it changes what direct light falls
    // on.
    virtual std::vector<std::string> components() const { return {}; }
    // All of its needs, met or not: the first is named where a row cannot act.
    virtual std::vector<Need> needs(const Scene&, const FrameOptions&) const { return {}; }

    virtual void visit(Visitor&) {}                  // knobs: see core/parameters.h
    virtual void prepare(gpu::Gpu&, const Scene&) {} // once per scene
    virtual Contribution render(gpu::Recorder& recorder, const Frame& frame) = 0; // once per frame

    virtual Receivers receivers() const { return Receivers::all; }
    // Adds to `direct` of other views of the scene what render() of the same frame lights there: mirrors and
    // glass show them. Slots up to caustics. Nothing where the technique knows only what the camera sees.
    virtual void light(gpu::Recorder&, const Frame&, const std::vector<Capture>&) {}
    // After render(): what it left out or merged, one sentence each.
    virtual std::vector<std::string> warnings() const { return {}; }

    // Slot::surface only: how height maps are searched while the frame, its shadow maps and every other
    // capture of the scene are drawn, before any render(). Without one they are not looked at.
    virtual std::optional<shared::HeightSearch> height_search() const { return std::nullopt; }

    // Whether render() takes the frame of an orthographic camera, whose view rays are parallel.
    virtual bool takes_parallel_views() const { return false; }

    // The renderer that has called prepare(); it expires with it.
    std::weak_ptr<const void> prepared_by;
};

struct TechniqueInfo {
    std::string name, summary;
    Slot slot;
    std::unique_ptr<Technique> (*make)();
};
const std::vector<TechniqueInfo>& all_techniques();

// "it needs a mirror or glass"; nothing where the technique can act.
std::optional<std::string> why_idle(const Technique& technique, const Scene& scene,
                                    const FrameOptions& frame);

// Made and configured. Error Fault::usage: unknown name (the known are listed) or unknown parameter.
std::unique_ptr<Technique> make_technique(const Specification& specification);

} // namespace luxel
