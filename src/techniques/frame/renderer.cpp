// SPDX-License-Identifier: MIT
#include "techniques/frame/renderer.h"

#include <algorithm>

#include "core/error.h"
#include "scene/lights.h"
#include "scene/roles.h"
#include "techniques/frame/ambient_params.h"
#include "techniques/frame/blending.h"
#include "techniques/frame/capture.h"
#include "techniques/frame/compose_params.h"
#include "techniques/frame/direct_light.h"
#include "techniques/frame/impostors.h"
#include "techniques/frame/named_image.h"
#include "techniques/frame/object_depth.h"
#include "techniques/frame/projection.h"

namespace luxel {

struct Renderer::Data {
    Data(gpu::Gpu& g, const Scene& s, const FrameOptions& o)
        : gpu(g), scene(s), options(o), on_gpu(g, s, o.mipmaps),
          shadows(g, o.shadow, o.esm_exponent,
                  std::min(std::uint64_t(o.shadow_memory) << 20, g.device().memory_bytes / 4)),
          direct(s, o), impostors(s), blended(blended_instances(s)) {
        if (has_ambient()) {
            std::vector<glm::vec3> sh = project_environment_sh(scene.environment);
            LUXEL_ASSERT(sh.size() == 9, "size={}", sh.size());
            std::copy(sh.begin(), sh.end(), ambient.sh);
        }
        environment = gpu.upload_image(
            scene.environment.empty() ? Image(1, 1, 3) : scene.environment.radiance, "environment");
        open = gpu.upload_image(Image(1, 1, 1, 1.0f), "open");
    }

    // A frame, and the alpha-blended surfaces over it, nearest first.
    struct Seen {
        Frame frame;
        std::vector<Capture> layers;
    };
    Seen make_frame(gpu::Recorder& recorder, const RenderRequest& request);
    gpu::Image ambient_light(gpu::Recorder& recorder, const Capture& capture, const std::string& name) const;
    void add_ambient(gpu::Recorder& recorder, const std::vector<Capture>& captures) const;
    void divide_receivers(gpu::Recorder& recorder, const Frame& frame,
                          const std::vector<Technique*>& techniques,
                          const std::vector<Contribution>& contributions) const;
    bool has_ambient() const { return has_ambient_light(scene, options); }
    void check_size(const RenderRequest& request) const;
    gpu::Image compose(gpu::Recorder& recorder, const Frame& frame,
                       const std::vector<Contribution>& contributions, const gpu::Image& accessibility) const;
    void lay_over(gpu::Recorder& recorder, const Seen& seen, const gpu::Image& radiance) const;

    // The mean of each pixel's samples; the image itself where a pixel has one.
    gpu::Image average(gpu::Recorder& recorder, const gpu::Image& image, const std::string& name) const;

    gpu::Gpu& gpu;
    const Scene& scene;
    FrameOptions options;
    GpuScene on_gpu;
    ShadowCache shadows;
    DirectLight direct;
    Impostors impostors;
    std::vector<bool> blended; // instances; empty: none
    shared::AmbientParams ambient{};
    gpu::Image environment, open; // open: accessibility 1
    std::uint64_t motion = 0;     // calls of update_motion
    std::shared_ptr<const void> identity = std::make_shared<int>(0);
};

namespace {

// Sorted by slot, then by receivers.
std::vector<Technique*> by_slot(std::vector<Technique*> techniques) {
    auto key = [](const Technique* t) { return std::pair(t->slot(), t->receivers()); };
    std::stable_sort(techniques.begin(), techniques.end(),
                     [&](const Technique* a, const Technique* b) { return key(a) < key(b); });
    for (std::size_t i = 1; i < techniques.size(); ++i)
        if (key(techniques[i - 1]) == key(techniques[i]))
            fail(Fault::usage,
                 "two techniques are for the slot \"{}\" and the same surfaces; use one of them",
                 slot_name(techniques[i]->slot()));
    return techniques;
}

// What is made for rays that meet in one eye refuses parallel ones.
void check_projection(const Camera& camera, const std::vector<Technique*>& techniques, bool impostors) {
    if (!camera.orthographic()) return;
    if (impostors)
        fail(Fault::usage, "camera \"{}\" is orthographic, which impostors cannot be drawn for", camera.name);
    for (const Technique* t : techniques)
        if (!t->takes_parallel_views())
            fail(Fault::usage,
                 "camera \"{}\" is orthographic, which the technique for the slot \"{}\" cannot take; use a "
                 "perspective camera",
                 camera.name, slot_name(t->slot()));
}

// Times of passes with the same name together, in the order of their first use.
std::vector<gpu::PassTime> sum_by_name(const std::vector<gpu::PassTime>& passes) {
    std::vector<gpu::PassTime> sums;
    for (const gpu::PassTime& pass : passes) {
        auto same =
            std::find_if(sums.begin(), sums.end(), [&](const auto& s) { return s.name == pass.name; });
        if (same == sums.end())
            sums.push_back(pass);
        else
            same->ms += pass.ms;
    }
    return sums;
}

Image without_alpha(const Image& rgba) {
    Image rgb(rgba.width, rgba.height, 3);
    for (int y = 0; y < rgb.height; ++y)
        for (int x = 0; x < rgb.width; ++x) rgb.set_rgb(x, y, rgba.rgb(x, y));
    return rgb;
}

// 1 where at least half of a pixel's square of samples has a depth.
Image mask_of(const Image& depth, int samples) {
    Image mask(depth.width / samples, depth.height / samples, 1);
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            int seen = 0;
            for (int i = 0; i < samples * samples; ++i)
                seen += *depth.at(x * samples + i % samples, y * samples + i / samples) > 0.0f;
            *mask.at(x, y) = 2 * seen >= samples * samples ? 1.0f : 0.0f;
        }
    return mask;
}

// Slots are in order, so the occlusion slot's accessibility comes before any other's. None: an empty handle.
gpu::Image accessibility_of(const std::vector<Contribution>& contributions) {
    auto found = std::find_if(contributions.begin(), contributions.end(),
                              [](const Contribution& c) { return bool(c.accessibility); });
    return found == contributions.end() ? gpu::Image() : found->accessibility;
}

} // namespace

Renderer::Data::Seen Renderer::Data::make_frame(gpu::Recorder& recorder, const RenderRequest& request) {
    Seen whole;
    Frame& f = whole.frame;
    std::optional<shared::HeightSearch> search;
    for (const Technique* t : request.techniques)
        if (t->slot() == Slot::surface) search = t->height_search();

    // What the camera sees. Impostors are in this view alone, and nothing is behind them.
    const int samples = options.supersample;
    CaptureRequest seen{.view = view_params(request.camera, request.width * samples, request.height * samples,
                                            on_gpu.bounds()),
                        .sides = Sides::seen};
    if (!impostors.empty()) seen.drawn = impostors.refresh(recorder, on_gpu, seen.view, search);
    static_cast<Capture&>(f) = capture_surfaces(recorder, on_gpu, seen, search);
    if (!impostors.empty()) impostors.draw(recorder, f);

    // What covers a part of its pixel lies over that, and is lit with it.
    if (!blended.empty()) {
        std::vector<bool> drawn = blended;
        for (std::size_t i = 0; i < seen.drawn.size(); ++i) drawn[i] = drawn[i] && seen.drawn[i];
        whole.layers = blended_layers(recorder, on_gpu, seen.view, drawn, options.blend_layers, search);
    }
    std::vector<Capture> lit = {f};
    lit.insert(lit.end(), whole.layers.begin(), whole.layers.end());
    direct.render(recorder, shadows, lit);

    f.capture_surfaces = [this, search, meshes = seen.drawn](gpu::Recorder& r, const CaptureRequest& c) {
        if (!c.behind_frame || meshes.empty()) return capture_surfaces(r, on_gpu, c, search);
        CaptureRequest behind = c;
        if (behind.drawn.empty()) behind.drawn.assign(meshes.size(), true);
        for (std::size_t i = 0; i < meshes.size(); ++i) behind.drawn[i] = behind.drawn[i] && meshes[i];
        return capture_surfaces(r, on_gpu, behind, search);
    };
    f.add_light = [this](gpu::Recorder& r, const std::vector<Capture>& captures) {
        direct.render(r, shadows, captures);
    };
    f.capture = [surfaces = f.capture_surfaces, light = f.add_light](gpu::Recorder& r,
                                                                     const CaptureRequest& c) {
        Capture capture = surfaces(r, c);
        light(r, {capture});
        return capture;
    };
    f.environment = environment;
    f.motion = motion;
    f.camera = request.camera;
    f.ambient = ambient_light(recorder, f, "ambient");
    f.ambient_sh = ambient;
    return whole;
}

gpu::Image Renderer::Data::ambient_light(gpu::Recorder& recorder, const Capture& capture,
                                         const std::string& name) const {
    const gpu::Image image = recorder.image({.width = capture.width, .height = capture.height}, name);
    if (!has_ambient())
        recorder.clear(image, {});
    else
        recorder.dispatch(
            "frame/ambient.comp", extent_of(image), ambient,
            {{"diffuse", capture.gbuffer.diffuse}, {"normal", capture.gbuffer.normal}, {"ambient", image}});
    return image;
}

void Renderer::Data::add_ambient(gpu::Recorder& recorder, const std::vector<Capture>& captures) const {
    if (!has_ambient()) return;
    for (const Capture& c : captures)
        recorder.dispatch(
            "frame/add.comp", extent_of(c.direct), gpu::Recorder::NoParams{},
            {{"contribution", ambient_light(recorder, c, "captured ambient")}, {"radiance", c.direct}});
}

// Takes what a technique for all surfaces gives to those that another one of its slot is for.
void Renderer::Data::divide_receivers(gpu::Recorder& recorder, const Frame& frame,
                                      const std::vector<Technique*>& techniques,
                                      const std::vector<Contribution>& contributions) const {
    for (std::size_t i = 1; i < techniques.size(); ++i) {
        if (techniques[i - 1]->slot() != techniques[i]->slot() || !contributions[i - 1].radiance) continue;
        const gpu::Image objects = object_depth(recorder, frame, only(scene, dynamic_objects(scene)));
        recorder.dispatch("frame/leave_objects.comp", extent_of(contributions[i - 1].radiance),
                          gpu::Recorder::NoParams{},
                          {{"hardware_depth", frame.gbuffer.hardware_depth},
                           {"object_depth", objects},
                           {"radiance", contributions[i - 1].radiance}});
    }
}

// Farthest first, so that each weakens what is behind it. Nothing that techniques compute is on them.
void Renderer::Data::lay_over(gpu::Recorder& recorder, const Seen& seen, const gpu::Image& radiance) const {
    for (std::size_t i = seen.layers.size(); i-- > 0;) {
        const Capture& layer = seen.layers[i];
        recorder.dispatch("frame/blend.comp", extent_of(radiance), gpu::Recorder::NoParams{},
                          {{"base_depth", seen.frame.gbuffer.depth},
                           {"layer_depth", layer.gbuffer.depth},
                           {"layer_normal", layer.gbuffer.normal},
                           {"layer_direct", layer.direct},
                           {"layer_ambient", ambient_light(recorder, layer, "blended ambient")},
                           {"radiance", radiance}});
    }
}

gpu::Image Renderer::Data::compose(gpu::Recorder& recorder, const Frame& frame,
                                   const std::vector<Contribution>& contributions,
                                   const gpu::Image& accessibility) const {
    gpu::Image radiance = recorder.image({.width = frame.width, .height = frame.height}, "radiance");
    shared::ComposeParams p{.view = frame.view,
                            .environment_rotation = scene.environment.rotation,
                            .environment_scale = scene.environment.empty() ? 0.0f : scene.environment.scale};
    recorder.dispatch("frame/compose.comp", extent_of(radiance), p,
                      {{"depth", frame.gbuffer.depth},
                       {"direct", frame.direct},
                       {"ambient", frame.ambient},
                       {"accessibility", accessibility ? accessibility : open},
                       {"environment", environment},
                       {"radiance", radiance}});
    for (const Contribution& c : contributions)
        if (c.radiance && c.from_afar && accessibility)
            recorder.dispatch(
                "frame/add_occluded.comp", extent_of(radiance), gpu::Recorder::NoParams{},
                {{"contribution", c.radiance}, {"accessibility", accessibility}, {"radiance", radiance}});
        else if (c.radiance)
            recorder.dispatch("frame/add.comp", extent_of(radiance), gpu::Recorder::NoParams{},
                              {{"contribution", c.radiance}, {"radiance", radiance}});
    return radiance;
}

gpu::Image Renderer::Data::average(gpu::Recorder& recorder, const gpu::Image& image,
                                   const std::string& name) const {
    if (options.supersample == 1 || !image) return image;
    const auto side = std::uint32_t(options.supersample);
    const gpu::Image mean = recorder.image(
        {.width = image.width() / side, .height = image.height() / side, .format = image.info().format},
        name);
    recorder.dispatch("frame/average.comp", extent_of(mean), gpu::Recorder::NoParams{},
                      {{"from", image}, {"to", mean}});
    return mean;
}

Renderer::Renderer(gpu::Gpu& gpu, const Scene& scene, const FrameOptions& options)
    : data_(std::make_unique<Data>(gpu, scene, options)) {}
Renderer::~Renderer() = default;

void Renderer::update_motion() {
    ++data_->motion;
    data_->on_gpu.move_instances(data_->gpu);
    data_->direct = DirectLight(data_->scene, data_->options);
}

void Renderer::Data::check_size(const RenderRequest& request) const {
    const int samples = options.supersample, most = max_image_side / samples;
    if (request.width < 1 || request.height < 1 || request.width > most || request.height > most)
        fail(Fault::usage, "{}x{}: the image size must be 1 to {} on both sides{}", request.width,
             request.height, most, samples > 1 ? fmt::format(" with supersample={}", samples) : "");
}

BaseFrame Renderer::base(const RenderRequest& request) {
    Data& d = *data_;
    d.check_size(request);
    d.gpu.reset_memory_peak();
    d.shadows.begin_frame();
    gpu::Recorder recorder(d.gpu);
    Data::Seen seen = d.make_frame(recorder, request);
    BaseFrame base{.frame = std::move(seen.frame), .layers = std::move(seen.layers)};
    base.passes = sum_by_name(recorder.submit());
    d.shadows.end_frame();
    base.memory_bytes = d.gpu.memory().peak;
    return base;
}

RenderResult Renderer::render(const RenderRequest& request) {
    Data& d = *data_;
    d.check_size(request);
    std::vector<Technique*> techniques = by_slot(request.techniques);
    check_projection(request.camera, techniques, !d.impostors.empty());
    for (Technique* t : techniques) {
        if (t->prepared_by.lock() == d.identity) continue;
        t->prepare(d.gpu, d.scene);
        t->prepared_by = d.identity;
    }

    // The frame as a program.
    d.gpu.reset_memory_peak();
    d.shadows.begin_frame();
    gpu::Recorder recorder(d.gpu);
    Renderer::Data::Seen seen = request.base ? Renderer::Data::Seen{request.base->frame, request.base->layers}
                                             : d.make_frame(recorder, request);
    const Frame& frame = seen.frame;
    std::vector<Contribution> contributions;
    seen.frame.add_indirect = [&](gpu::Recorder& r, const std::vector<Capture>& captures) {
        d.add_ambient(r, captures);
        for (std::size_t i = 0; i < contributions.size(); ++i) techniques[i]->light(r, frame, captures);
    };
    for (Technique* t : techniques) contributions.push_back(t->render(recorder, frame));
    d.divide_receivers(recorder, frame, techniques, contributions);
    const gpu::Image open_share = accessibility_of(contributions);
    const gpu::Image composed = d.compose(recorder, frame, contributions, open_share);
    d.lay_over(recorder, seen, composed);
    const gpu::Image radiance = d.average(recorder, composed, "mean radiance");
    const gpu::Image accessibility =
        request.accessibility ? d.average(recorder, open_share, "mean accessibility") : gpu::Image();

    RenderResult result;
    result.passes = sum_by_name(recorder.submit());
    d.shadows.end_frame();
    result.memory_bytes = d.gpu.memory().peak;
    if (!request.read) return result;
    result.radiance = without_alpha(d.gpu.read(radiance));
    Image depth = d.gpu.read(frame.gbuffer.depth);
    if (!seen.layers.empty()) { // the first layer has something wherever any has
        const Image layer = d.gpu.read(seen.layers.front().gbuffer.depth);
        for (std::size_t i = 0; i < depth.data.size(); ++i)
            depth.data[i] = std::max(depth.data[i], layer.data[i]);
    }
    for (const Technique* t : techniques)
        for (const std::string& warning : t->warnings()) result.warnings.push_back(warning);
    result.mask = mask_of(depth, d.options.supersample);
    if (accessibility) result.accessibility = d.gpu.read(accessibility);
    for (const std::string& name : request.images)
        result.images[name] = read_named_image(d.gpu, recorder.images(), name);
    return result;
}

} // namespace luxel
