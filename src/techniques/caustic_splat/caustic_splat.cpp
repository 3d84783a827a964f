// SPDX-License-Identifier: MIT
// Caustics by photon splats on a cube map: the baseline of caustic_triangles.
#include "techniques/common/caustics.h"

namespace luxel {
namespace {

class CausticSplat final : public CausticTechnique {
public:
    CausticSplat() : CausticTechnique("caustic_splat") {}
    bool takes_parallel_views() const override { return true; }
    void visit(Visitor& v) override {
        options_.visit(v);
        v.real("radius", radius_, {0.5, 128}, "of a photon, texels of the caustic cube map");
    }

private:
    void draw(gpu::Recorder& recorder, const Photons& photons, const DistanceCube& receivers,
              const std::vector<CausticFace>& faces) const override {
        for (const CausticFace& face : faces)
            splat_photons(recorder, photons, photons.powers, receivers, face, radius_);
    }

    float radius_ = 8.0f;
};

} // namespace

std::unique_ptr<Technique> make_caustic_splat() { return std::make_unique<CausticSplat>(); }

} // namespace luxel
