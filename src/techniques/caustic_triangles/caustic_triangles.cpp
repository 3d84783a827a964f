// SPDX-License-Identifier: MIT
// Caustics by triangles between neighboring photons [Umenhoffer2009, chapter 6].
#include "techniques/caustic_triangles/caustic_triangles_params.h"
#include "techniques/common/caustics.h"

namespace luxel {
namespace {

enum class CausticArea { third, thesis };
enum class CausticRim { splat, flux, density }; // CAUSTIC_RIM_*

class CausticTriangles final : public CausticTechnique {
public:
    CausticTriangles() : CausticTechnique("caustic_triangles") {}
    bool takes_parallel_views() const override { return true; }
    void visit(Visitor& v) override {
        options_.visit(v);
        v.choice("area", area_, {"third", "thesis"},
                 "a photon's share of the triangles around it: a third, or half as the thesis has it");
        v.choice(
            "rim", rim_, {"splat", "flux", "density"},
            "the share of a photon's triangles that are missing: splatted, given to the others, or lost");
        v.real("tear", tear_, {0.001, 100},
               "share of its distance that the middle of a triangle may be off the surface");
        v.real("least", least_, {0, 100}, "texels below which a triangle is not drawn");
    }

private:
    void draw(gpu::Recorder& recorder, const Photons& photons, const DistanceCube& receivers,
              const std::vector<CausticFace>& faces) const override {
        const shared::CausticAreaParams p{.photons = photons.side,
                                          .size = options_.size,
                                          .tear = tear_,
                                          .least = least_,
                                          .share = area_ == CausticArea::third ? 1.0f / 3.0f : 0.5f,
                                          .rim = std::uint32_t(rim_)};
        const std::uint32_t side = std::uint32_t(photons.side);
        gpu::Image areas = recorder.image({.width = side, .height = side, .format = VK_FORMAT_R32G32_SFLOAT},
                                          "caustic areas");
        auto image = [&](const char* name) {
            return recorder.image({.width = side, .height = side, .format = VK_FORMAT_R32G32B32A32_SFLOAT},
                                  name);
        };
        gpu::Image irradiance = image("caustic irradiance"), left_over = image("caustic left over");
        recorder.dispatch("caustic_triangles/areas.comp", extent_of(areas), p,
                          {{"hits", photons.hits},
                           {"distance_map", receivers.distance, gpu::Sampler::linear_clamp},
                           {"areas", areas}});
        recorder.dispatch("caustic_triangles/irradiance.comp", extent_of(areas), p,
                          {{"powers", photons.powers},
                           {"areas", areas},
                           {"irradiance", irradiance},
                           {"left_over", left_over}});

        const std::vector<gpu::Batch> all = {{.draws = {{.count = 6 * side * side}}}};
        for (const CausticFace& face : faces) {
            const gpu::RasterPass pass{.color = {{.image = face.target, .blend = gpu::Blend::add}}};
            recorder.draw("caustic_triangles/triangle", pass, face.params,
                          {{"hits", photons.hits}, {"areas", areas}, {"irradiance", irradiance}}, {}, all);
            splat_photons(recorder, photons, left_over, receivers, face, face.params.radius);
        }
    }

    CausticArea area_ = CausticArea::third;
    CausticRim rim_ = CausticRim::splat;
    float tear_ = 0.3f;
    float least_ = 0.1f;
};

} // namespace

std::unique_ptr<Technique> make_caustic_triangles() { return std::make_unique<CausticTriangles>(); }

} // namespace luxel
