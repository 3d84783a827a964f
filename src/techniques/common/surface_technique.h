// SPDX-License-Identifier: MIT
// What the techniques of the surface slot have in common: all they do is say how height maps are searched.
#pragma once
#include "scene/height_field.h"
#include "techniques/technique.h"

namespace luxel {

class SurfaceTechnique : public Technique {
public:
    explicit SurfaceTechnique(bool depth) : depth_(depth) {}
    Slot slot() const override { return Slot::surface; }
    bool takes_parallel_views() const override { return true; }
    std::vector<std::string> components() const override { return {"direct"}; }
    std::vector<Need> needs(const Scene& scene, const FrameOptions&) const override {
        return {{"a material with a height map", has_height_fields(scene)}};
    }
    Contribution render(gpu::Recorder&, const Frame&) override { return {}; }

protected:
    void visit_depth(Visitor& v) {
        v.flag("depth", depth_, "the frame's depth is that of the relief: it shadows and hides, also itself");
    }
    bool depth_;
};

} // namespace luxel
