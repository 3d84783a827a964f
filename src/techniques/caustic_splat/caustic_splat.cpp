// SPDX-License-Identifier: MIT
// Caustics by photon splats on a cube map: the baseline of caustic_triangles.
#include "techniques/common/caustics.h"

namespace luxel {
namespace {

class CausticSplat final : public Technique {
public:
    Slot slot() const override { return Slot::caustics; }
    void visit(Visitor& v) override {
        options_.visit(v);
        v.real("radius", radius_, {0.5, 128}, "of a photon, texels of the caustic cube map");
    }
    void prepare(gpu::Gpu&, const Scene& scene) override { objects_ = specular_objects(scene); }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override {
        auto scope = recorder.scope("caustic_splat");
        return caustics(recorder, frame, objects_, options_,
                        [&](gpu::Recorder& r, const Photons& photons, const DistanceCube& receivers,
                            const std::vector<CausticFace>& faces) {
                            for (const CausticFace& face : faces)
                                splat_photons(r, photons, photons.powers, receivers, face, radius_);
                        });
    }

private:
    CausticOptions options_;
    float radius_ = 8.0f;
    std::vector<SceneObject> objects_;
};

} // namespace

std::unique_ptr<Technique> make_caustic_splat() { return std::make_unique<CausticSplat>(); }

} // namespace luxel
