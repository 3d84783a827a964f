// SPDX-License-Identifier: MIT
#include "techniques/frame/shadow_maps.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "shared/sampling.h"
#include "techniques/frame/esm_params.h"
#include "techniques/frame/projection.h"
#include "techniques/frame/scene_depth.h"

namespace luxel {
namespace {

// Texels around what a map must cover: the PCF kernel reaches 2 texels, and the receiver's offset up to
// 4 half texels along each axis' share of the normal, 2 sqrt(2) texels at most.
constexpr int guard = 5;
float guarded(int size) { return float(size) / float(size - 2 * guard); }

// A perspective map keeps a relative depth precision of DEPTH_ROUNDING * far / near: with this ratio a
// thousandth at worst, half a texel of a 2048-texel map of 90 degrees.
constexpr float near_by_far = 1.0f / 2048.0f;

// Wider cones waste their texels on the rim: the five faces of a cube take over at 120 degrees.
constexpr float widest_tangent = 1.7320508f;

float outer_tangent(const shared::Light& light) {
    return std::max(shared::versine_tangent(light.outer), 1e-6f);
}

// Columns; z = the light's direction.
glm::mat3 light_axes(const shared::Light& light) {
    if (light.type == shared::LIGHT_POINT) return glm::mat3(1.0f);
    return shared::frame_around(glm::normalize(light.direction));
}

float farthest_corner(const Bounds& b, glm::vec3 from) {
    return std::max(glm::length(glm::max(glm::abs(b.least - from), glm::abs(b.most - from))), 1e-3f);
}

shared::ShadowView perspective_view(glm::vec3 position, const LightCone& cone, float far, int size) {
    const float tangent = cone.tangent * guarded(size);
    shared::ShadowView v{};
    v.world_to_map = perspective_to_clip({position, cone.forward, cone.right * tangent, cone.up * tangent},
                                         far * near_by_far);
    v.right = cone.right, v.up = cone.up;
    v.half_texel = glm::vec2(tangent / float(size));
    v.near_by_far = near_by_far;
    return v;
}

shared::ShadowView directional_view(const shared::ShadowedLight& light, const Bounds& scene,
                                    const std::vector<glm::vec3>& receivers, int size) {
    // The receivers' rectangle as the light sees it.
    const glm::mat3& axes = light.axes;
    Bounds box;
    for (glm::vec3 p : receivers) box.add(p * axes);
    if (box.empty()) box.add(scene.least * axes), box.add(scene.most * axes);
    glm::vec2 half = glm::max(glm::vec2(box.most - box.least) * 0.5f, glm::vec2(1e-4f)) * guarded(size);

    // Everything in the scene may cast a shadow, also what lies outside of the camera's view.
    float radius = std::max(scene.radius(), 1e-3f) * 1.001f;
    float middle = glm::dot(scene.center(), axes[2]);
    glm::vec3 origin = axes * glm::vec3(glm::vec2(box.center()), middle - radius);

    shared::ShadowView v{};
    v.world_to_map =
        orthographic_to_clip({origin, axes[2], axes[0] * half.x, axes[1] * half.y}, 0.0f, 2.0f * radius);
    v.right = axes[0], v.up = axes[1];
    v.half_texel = half / float(size);
    v.near_by_far = 0.0f;
    return v;
}

// What this batch has written of an array.
gpu::Image first_layers(gpu::Image array, std::uint32_t count) {
    array.layer_count = count;
    return array;
}

} // namespace

int shadow_map_count(const shared::Light& light) {
    if (light.type == shared::LIGHT_POINT) return 6;
    if (light.type == shared::LIGHT_COSINE) return 5;
    if (light.type == shared::LIGHT_SPOT && outer_tangent(light) > widest_tangent) return 5;
    return 1;
}

std::vector<LightCone> light_cones(const shared::Light& light) {
    if (light.type == shared::LIGHT_DIRECTIONAL) return {};
    const glm::mat3 axes = light_axes(light);
    const glm::vec3 &x = axes[0], &y = axes[1], &z = axes[2];
    if (shadow_map_count(light) == 1) return {{z, x, y, outer_tangent(light)}};
    std::vector<LightCone> faces = {{z, x, y, 1}, {x, y, z, 1},  {-x, y, z, 1},
                                    {y, z, x, 1}, {-y, z, x, 1}, {-z, x, y, 1}};
    faces.resize(std::size_t(shadow_map_count(light)));
    return faces;
}

FittedLight fit_shadow_maps(const shared::Light& light, const Bounds& scene,
                            const std::vector<glm::vec3>& receivers, int size) {
    LUXEL_ASSERT(size > 2 * guard, "size={}", size);
    FittedLight fitted;
    shared::ShadowedLight& l = fitted.light;
    l.light = light;
    l.axes = light_axes(light);
    l.first_map = 0;
    l.maps = shared::uint(shadow_map_count(light));
    if (light.type == shared::LIGHT_DIRECTIONAL) {
        fitted.views = {directional_view(l, scene, receivers, size)};
        return fitted;
    }

    float far = farthest_corner(scene, light.position);
    if (light.range > 0.0f) far = std::min(far, light.range);
    for (const LightCone& cone : light_cones(light))
        fitted.views.push_back(perspective_view(light.position, cone, far, size));
    return fitted;
}

ShadowMaps::ShadowMaps(gpu::Gpu& gpu, int size, int layers, ShadowMode mode, bool with_sheets) : mode_(mode) {
    gpu::ImageInfo info{.width = std::uint32_t(size),
                        .height = std::uint32_t(size),
                        .format = VK_FORMAT_D32_SFLOAT,
                        .layers = std::uint32_t(layers)};
    depth_ = gpu.image(info, "shadow maps");
    if (with_sheets) {
        info.format = optical_depth_format;
        sheets_.optical_depth = gpu.image(info, "sheets' optical depth");
        info.format = nearest_sheet_format;
        sheets_.nearest = gpu.image(info, "nearest sheets");
    }
    if (mode != ShadowMode::esm) return;
    info.format = VK_FORMAT_R32_SFLOAT;
    filtered_ = gpu.image(info, "filtered shadow maps");
    temporary_ = gpu.image(info, "half filtered shadow maps");
}

std::uint64_t ShadowMaps::bytes_of(int size, int layers, ShadowMode mode, bool with_sheets) {
    const std::uint64_t words = (mode == ShadowMode::esm ? 3 : 1) + (with_sheets ? 3 : 0);
    return words * 4 * std::uint64_t(size) * std::uint64_t(size) * std::uint64_t(layers);
}

ShadowImages ShadowMaps::draw(gpu::Recorder& recorder, const GpuScene& scene,
                              const std::vector<shared::ShadowView>& views, float esm_exponent,
                              const std::optional<shared::HeightSearch>& search) const {
    LUXEL_ASSERT(int(views.size()) <= layers(), "views={} layers={}", views.size(), layers());

    auto scope = recorder.scope("shadow");

    for (std::uint32_t i = 0; i < views.size(); ++i) {
        const gpu::Image map = depth_.layer(i);
        draw_depth(recorder, scene, views[i].world_to_map, map, search, scene.solids());
        if (with_sheets())
            draw_sheets(recorder, scene, views[i].world_to_map, map,
                        {sheets_.optical_depth.layer(i), sheets_.nearest.layer(i)});
    }
    gpu::Extent threads{depth_.width(), depth_.height(), std::uint32_t(views.size())};
    ShadowImages images{.depth = first_layers(depth_, threads.z)};
    if (with_sheets())
        images.sheets = {first_layers(sheets_.optical_depth, threads.z),
                         first_layers(sheets_.nearest, threads.z)};
    if (mode_ != ShadowMode::esm) return images;

    // Blur of exp(c z) along x, then y.
    shared::EsmParams p{
        .direction = {1, 0}, .exponent = esm_exponent, .maps = int(views.size()), .reversed = 1};
    std::copy(views.begin(), views.end(), p.views);
    gpu::Image temporary = first_layers(temporary_, threads.z), filtered = first_layers(filtered_, threads.z);
    recorder.dispatch("frame/esm_blur.comp", threads, p, {{"from", images.depth}, {"to", temporary}});
    p.direction = {0, 1}, p.reversed = 0;
    recorder.dispatch("frame/esm_blur.comp", threads, p, {{"from", temporary}, {"to", filtered}});
    images.depth = filtered;
    return images;
}

} // namespace luxel
