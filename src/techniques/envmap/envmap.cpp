// SPDX-License-Identifier: MIT
#include "techniques/envmap/envmap.h"

#include "techniques/common/light_samples.h"
#include "techniques/envmap/probes.h"
#include "techniques/frame/object_depth.h"

namespace luxel {

using gpu::Recorder;

void EnvmapOptions::visit(Visitor& v) {
    v.choice(
        "estimator", estimator, {"classic", "point", "disc", "polygon"},
        "irradiance of the map's texels: by normal alone, as points, bounded as discs, exact as polygons");
    v.only_if(estimator == EnvmapEstimator::polygon, "estimator=polygon", [&] {
        v.choice("horizon", horizon, {"clip", "clamp_sum", "thesis"},
                 "polygons across the horizon: clipped; the sum clamped; each edge clamped");
        v.choice("corner", corner, {"exact", "averaged"},
                 "distances of the polygons' corners: of the captured map, or of the reduced one");
        v.choice("radiance", radiance, {"texel", "corners"},
                 "of a polygon: its texel's, or the mean of those that meet at its corners");
    });
    v.choice("light", light, {"bounce", "all"},
             "bounce: direct light that diffuse lobes reflect; all: also emission, highlights, environment");
    v.integer("texels", texels, {1, 16}, "a side of a reduced face, a power of two; 6 texels^2 senders");
    v.integer("size", size, {16, 1024}, "texels a side of a captured face, a power of two");
    v.choice("probes", probes, {"objects", "grid"},
             "objects: one for each object whose role begins with \"dynamic\"; grid: for the whole scene");
    v.only_if(probes == EnvmapProbes::objects, "probes=objects", [&] {
        v.flag("glossy", glossy,
               "also what rough specular lobes reflect, by one look-up in a prefiltered map");
    });
    v.only_if(probes == EnvmapProbes::grid, "probes=grid", [&] {
        v.integer("grid", grid, {1, 16}, "probes along the scene's longest side");
    });
    v.flag("occlusion", occlusion, "times what the occlusion slot leaves open");
}

std::vector<std::string> Envmap::components() const {
    if (options_.glossy) return {"diffuse1", "specular"};
    return {"diffuse1"};
}

// With light=all what emitters and the environment send counts whether or not the frame samples them.
std::vector<Need> Envmap::needs(const Scene& scene, const FrameOptions& frame) const {
    const bool objects = options_.probes == EnvmapProbes::grid || !dynamic_objects(scene).empty();
    return {{"an object whose role begins with \"dynamic\", or probes=grid", objects},
            options_.light == EnvmapLight::all ? light_need(scene, LightSamples{})
                                               : light_need(scene, frame)};
}

namespace {

// A program for each estimator: CPU drivers execute untaken branches.
std::string program_of(const EnvmapOptions& o) {
    static constexpr const char* estimators[] = {"classic", "point", "disc"};
    static constexpr const char* horizons[] = {"clip", "clamp_sum", "thesis"};
    const bool polygon = o.estimator == EnvmapEstimator::polygon;
    return std::string(o.probes == EnvmapProbes::grid ? "envmap/grid_" : "envmap/gather_") +
           (polygon ? horizons[std::size_t(o.horizon)] : estimators[std::size_t(o.estimator)]) + ".comp";
}

void gather(Recorder& recorder, const Frame& frame, const EnvmapOptions& options,
            const EnvmapSenders& senders, shared::EnvmapGatherParams p, const gpu::Image& object,
            const gpu::Image& radiance) {
    const GBuffer& g = frame.gbuffer;
    gpu::Bindings bindings = {
        {"depth", g.depth}, {"normal", g.normal}, {"diffuse", g.diffuse}, {"radiance", radiance}};
    if (senders.convolved)
        bindings.push_back({"convolved", senders.convolved, gpu::Sampler::linear_clamp});
    else
        bindings.push_back({"list", senders.list});
    if (object) {
        bindings.push_back({"hardware_depth", g.hardware_depth});
        bindings.push_back({"object_depth", object});
    } else {
        bindings.push_back({"distance_from_center", senders.distance});
    }
    recorder.dispatch(program_of(options), extent_of(radiance), p, bindings);
}

void gather_glossy(Recorder& recorder, const Frame& frame, const EnvmapSenders& senders,
                   const gpu::Image& reflectance, const shared::EnvmapGatherParams& p,
                   const gpu::Image& object, const gpu::Image& radiance) {
    const GBuffer& g = frame.gbuffer;
    recorder.dispatch("envmap/glossy.comp", extent_of(radiance), p,
                      {{"depth", g.depth},
                       {"normal", g.normal},
                       {"diffuse", g.diffuse},
                       {"specular", g.specular},
                       {"direct", frame.direct},
                       {"hardware_depth", g.hardware_depth},
                       {"object_depth", object},
                       {"prefiltered", senders.prefiltered, gpu::Sampler::linear_clamp},
                       {"reflectance", reflectance, gpu::Sampler::linear_clamp},
                       {"radiance", radiance}});
}

} // namespace

void Envmap::prepare(gpu::Gpu& gpu, const Scene&) {
    if (options_.glossy) reflectance_ = tabulate_reflectance(gpu);
}

Contribution Envmap::render(Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope("envmap");
    check_envmap_options(options_);
    Contribution c{.radiance =
                       recorder.image({.width = frame.width, .height = frame.height}, "envmap radiance")};
    c.from_afar = options_.occlusion;
    recorder.clear(c.radiance, {});
    shared::EnvmapGatherParams p{.view = frame.view, .senders = 6 * options_.texels * options_.texels};

    if (options_.probes == EnvmapProbes::grid) {
        std::vector<CubeLayer> probes = grid_probes(frame.scene->bounds(), options_.grid, p);
        EnvmapSenders senders = find_senders(recorder, frame, probes, options_);
        gather(recorder, frame, options_, senders, p, {}, c.radiance);
        return c;
    }
    const Scene& scene = frame.scene->scene();
    std::vector<SceneObject> objects = dynamic_objects(scene);
    if (objects.empty()) return c;
    EnvmapSenders senders = find_senders(recorder, frame, object_probes(*frame.scene, objects), options_);
    for (std::size_t i = 0; i < objects.size(); ++i) {
        p.probe = int(i);
        const gpu::Image object = object_depth(recorder, frame, only(scene, {objects[i]}));
        gather(recorder, frame, options_, senders, p, object, c.radiance);
        if (options_.glossy) gather_glossy(recorder, frame, senders, reflectance_, p, object, c.radiance);
    }
    return c;
}

std::unique_ptr<Technique> make_envmap() { return std::make_unique<Envmap>(); }

} // namespace luxel
