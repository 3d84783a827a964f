// SPDX-License-Identifier: MIT
// Billboards toward one eye: what they show, and how wrong they are from another.
#pragma once
#include <optional>

#include "scene/scene.h"
#include "techniques/frame/impostor_params.h"
#include "techniques/frame/view_params.h"

namespace luxel {

// The view of a box from the camera's position, square, with a rim of a texel. None where a billboard makes
// no sense: the box reaches behind the eye or is wider than 90 degrees.
std::optional<shared::ViewParams> impostor_view(const Bounds& bounds, const shared::ViewParams& camera,
                                                int size);

// The rectangle of that view whose plane lies at `depth`.
shared::ImpostorCard card_of(const shared::ViewParams& view, float depth);
// Depth of the plane that is as wrong for the box's nearest corner as for its farthest: a sideways step of
// the eye by s moves a point against the plane by s |1/z - 1/depth|.
float balanced_depth(const Bounds& bounds, const shared::ViewParams& view);

// Largest angle, seen from the camera, between a point of the box and where the card shows it, in pixels of
// the image's center. [Schaufler1995] takes the box's corners, here it is a grid on its surface.
float displacement(const Bounds& bounds, const shared::ImpostorCard& card, const shared::ViewParams& camera);
// The same angle for one point of the object.
float displacement(glm::vec3 point, const shared::ImpostorCard& card, const shared::ViewParams& camera);

} // namespace luxel
