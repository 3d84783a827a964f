// SPDX-License-Identifier: MIT
// What the camera sees in place of the meshes of objects with an impostor; kept from frame to frame.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "techniques/frame/frame.h"
#include "techniques/frame/impostor_cloud.h"

namespace luxel {

class Impostors {
public:
    // Chooses the planes of billboard clouds. Errors: those of make_cloud.
    explicit Impostors(const Scene& scene);
    bool empty() const { return items_.empty(); }

    // Draws anew what this view would see too wrong. Returns the instances that the view draws as meshes:
    // those without an impostor, and those that the eye is too close to.
    std::vector<bool> refresh(gpu::Recorder& recorder, const GpuScene& scene, const shared::ViewParams& view,
                              const std::optional<shared::HeightSearch>& search);
    // Adds the impostors to a view that its meshes have been drawn into. After refresh() of that view.
    void draw(gpu::Recorder& recorder, const Capture& view) const;

private:
    struct Item {
        ImpostorObject object;
        ImpostorCloud cloud;
        std::vector<shared::ImpostorCard> cards;
        std::optional<Capture> samples;
        std::vector<glm::mat4> transforms; // of the instances when the cards were made
        std::vector<glm::mat4> made_at;    // and the cloud's planes
        bool shown = false;
    };
    void refresh_board(gpu::Recorder& recorder, const GpuScene& scene, const shared::ViewParams& view,
                       const std::optional<shared::HeightSearch>& search, Item& item,
                       std::vector<bool>& drawn);
    void refresh_cloud(gpu::Recorder& recorder, const GpuScene& scene, Item& item);
    std::vector<glm::mat4> transforms_of(const Item& item) const;

    const Scene* scene_;
    std::vector<Item> items_;
    gpu::Buffer cards_; // of all items
    bool cards_are_old_ = true;
};

} // namespace luxel
