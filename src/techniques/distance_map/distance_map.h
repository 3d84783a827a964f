// SPDX-License-Identifier: MIT
// Mirrors and glass by rays through distance cube maps: single reflections with one map
// [Umenhoffer2009, 2.3.2], paths of reflections and refractions with layers of it [Umenhoffer2009, chapter
// 5].
#pragma once
#include "techniques/common/cube_trace.h"
#include "techniques/technique.h"

namespace luxel {

class DistanceMap final : public Technique {
public:
    Slot slot() const override { return Slot::specular; }
    bool takes_parallel_views() const override { return true; }
    std::vector<std::string> components() const override { return {"reflections"}; }
    std::vector<Need> needs(const Scene& scene, const FrameOptions&) const override {
        return {specular_need(specular_objects(scene))};
    }
    void visit(Visitor& v) override;
    void prepare(gpu::Gpu& gpu, const Scene& scene) override;
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override;
    std::vector<std::string> warnings() const override {
        return shared_maps_warning(objects_, options_.maps);
    }

private:
    CubeTraceOptions options_;
    CubePathOptions paths_;
    bool indirect_ = true;
    std::vector<SceneObject> objects_;
};

} // namespace luxel
