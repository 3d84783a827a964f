// SPDX-License-Identifier: MIT
#include "techniques/frame/impostors.h"

#include <cstring>

#include "techniques/frame/capture.h"
#include "techniques/frame/gbuffer.h"
#include "techniques/frame/impostor_view.h"

namespace luxel {
namespace {

bool same(const std::optional<shared::HeightSearch>& a, const std::optional<shared::HeightSearch>& b) {
    if (a.has_value() != b.has_value()) return false;
    return !a || std::memcmp(&*a, &*b, sizeof *a) == 0;
}

gpu::Bindings sample_bindings(const Capture& samples) {
    const GBuffer& g = samples.gbuffer;
    return {{"diffuse", g.diffuse}, {"specular", g.specular},
            {"normal", g.normal},   {"geometric_normal", g.geometric_normal},
            {"depth", g.depth},     {"emission", samples.direct}};
}

} // namespace

Impostors::Impostors(const Scene& scene) : scene_(&scene) {
    for (ImpostorObject& object : impostor_objects(scene)) {
        Item& item = items_.emplace_back();
        item.object = std::move(object);
        if (item.object.impostor.kind != ImpostorKind::billboard_cloud) continue;
        item.cloud = make_cloud(scene, item.object);
        item.made_at = transforms_of(item);
    }
}

std::vector<glm::mat4> Impostors::transforms_of(const Item& item) const {
    std::vector<glm::mat4> transforms;
    for (int i : item.object.instances) transforms.push_back(scene_->instances[std::size_t(i)].transform);
    return transforms;
}

std::vector<bool> Impostors::refresh(gpu::Recorder& recorder, const GpuScene& scene,
                                     const shared::ViewParams& view,
                                     const std::optional<shared::HeightSearch>& search) {
    auto scope = recorder.scope("impostor redraw");
    std::vector<bool> drawn(scene_->instances.size(), true);
    for (const Item& item : items_)
        for (int i : item.object.instances) drawn[std::size_t(i)] = false;
    for (Item& item : items_) {
        if (item.object.impostor.kind == ImpostorKind::billboard_cloud)
            refresh_cloud(recorder, scene, item);
        else
            refresh_board(recorder, scene, view, search, item, drawn);
    }
    if (!cards_are_old_) return drawn;
    std::vector<shared::ImpostorCard> cards;
    for (const Item& item : items_) cards.insert(cards.end(), item.cards.begin(), item.cards.end());
    cards_ = recorder.gpu().upload(std::span<const shared::ImpostorCard>(cards), "impostor cards");
    cards_are_old_ = false;
    return drawn;
}

void Impostors::refresh_board(gpu::Recorder& recorder, const GpuScene& scene, const shared::ViewParams& view,
                              const std::optional<shared::HeightSearch>& search, Item& item,
                              std::vector<bool>& drawn) {
    const Bounds bounds = scene.bounds_of(item.object.instances);
    item.shown = touches(frustum_of(view.world_to_clip), bounds);
    if (!item.shown) return;
    const Impostor& impostor = item.object.impostor;
    const auto toward = impostor_view(bounds, view, impostor.size);
    if (!toward) {
        for (int i : item.object.instances) drawn[std::size_t(i)] = true;
        item.shown = false;
        return;
    }

    // An impostor lasts until a point of the object may be seen too far from where it is shown
    // [Schaufler1995].
    std::vector<glm::mat4> transforms = transforms_of(item);
    if (item.samples && transforms == item.transforms && same(search, item.samples->search) &&
        displacement(bounds, item.cards[0], view) <= impostor.error)
        return;
    item.transforms = std::move(transforms);
    item.cards = {card_of(*toward, balanced_depth(bounds, *toward))};
    CaptureRequest request{
        .view = *toward, .prefix = "impostor " + item.object.name + " ", .sides = Sides::seen};
    request.drawn.assign(scene_->instances.size(), false);
    for (int i : item.object.instances) request.drawn[std::size_t(i)] = true;
    item.samples = capture_surfaces(recorder, scene, request, search);
    item.samples->direct_diffuse = {};
    cards_are_old_ = true;
}

void Impostors::refresh_cloud(gpu::Recorder& recorder, const GpuScene& scene, Item& item) {
    std::vector<glm::mat4> transforms = transforms_of(item);
    if (item.samples && transforms == item.transforms) return;

    // Samples move with the instances; only where those moved apart the planes are chosen again.
    const auto motion = item.samples ? common_motion(item.made_at, transforms) : std::nullopt;
    if (motion) {
        item.cards = moved(item.cloud.cards, *motion);
    } else {
        if (transforms != item.made_at) item.cloud = make_cloud(*scene_, item.object);
        item.made_at = transforms;
        item.cards = item.cloud.cards;
        item.shown = !item.cards.empty();
        if (!item.shown) return;
        item.samples = draw_cloud(recorder, scene, item.object, item.cloud);
        item.samples->direct_diffuse = {};
    }
    item.transforms = std::move(transforms);
    cards_are_old_ = true;
}

void Impostors::draw(gpu::Recorder& recorder, const Capture& view) const {
    auto scope = recorder.scope("impostor");
    std::vector<gpu::Batch> flat, deep;
    std::uint32_t first = 0;
    for (const Item& item : items_) {
        const std::uint32_t count = std::uint32_t(item.cards.size());
        const bool has_depth = item.object.impostor.kind == ImpostorKind::nailboard;
        if (item.shown)
            (has_depth ? deep : flat)
                .push_back(
                    {sample_bindings(*item.samples), {{.count = 6, .instance = first, .instances = count}}});
        first += count;
    }
    gpu::RasterPass pass = gbuffer_pass(view);
    load_targets(pass);
    const gpu::Bindings bindings = {{"cards", cards_}};
    if (!flat.empty()) recorder.draw("frame/impostor_flat", pass, view.view, bindings, {}, flat);
    if (!deep.empty()) recorder.draw("frame/impostor_deep", pass, view.view, bindings, {}, deep);
}

} // namespace luxel
