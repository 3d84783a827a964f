// SPDX-License-Identifier: MIT
#include "reference/content_key.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace luxel {
namespace {

// Raise with every change that alters images.
constexpr std::uint32_t tracer_version = 4;

template <int N> void add(ContentKey& key, const glm::vec<N, float>& v) { key.add_bytes(&v, sizeof v); }

void add(ContentKey& key, const TextureUse& use) {
    key.add(use.texture);
    if (use.texture < 0) return;
    key.add(use.set);
    key.add_bytes(&use.transform, sizeof use.transform);
}

void add(ContentKey& key, const Material& m) {
    add(key, m.base_color), add(key, m.emission), add(key, m.specular_color);
    for (float value :
         {m.metallic, m.roughness, m.normal_scale, m.ior, m.specular, m.transmission, m.alpha_cutoff})
        key.add(value);
    for (int value : {int(m.thin), int(m.alpha_mode), int(m.double_sided)}) key.add(value);
    for (const TextureUse* use :
         {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.emission_texture,
          &m.specular_texture, &m.specular_color_texture, &m.transmission_texture})
        add(key, *use);
    add(key, m.attenuation_color);
    for (float value : {m.attenuation_distance, m.clearcoat, m.clearcoat_roughness, m.clearcoat_normal_scale})
        key.add(value);
    for (const TextureUse* use :
         {&m.clearcoat_texture, &m.clearcoat_roughness_texture, &m.clearcoat_normal_texture})
        add(key, *use);
    // Nothing is added without: keys of before stay as they are.
    if (m.backs_unseen) key.add(std::string_view("backs unseen"));
    if (m.has_relief()) add(key, m.height_texture), key.add(m.height_scale);
}

void add(ContentKey& key, const Mesh& m) {
    key.add(m.positions), key.add(m.normals), key.add(m.tangents);
    key.add(m.texcoords[0]), key.add(m.texcoords[1]);
    key.add(m.colors), key.add(m.indices), key.add(m.material);
}

void add(ContentKey& key, const Texture& t) {
    for (int value :
         {t.pixels.width, t.pixels.height, int(t.srgb), int(t.wrap_u), int(t.wrap_v), int(t.nearest)})
        key.add(value);
    key.add(t.pixels.rgba);
    if (t.pixels.is_wide()) key.add(t.pixels.wide);
}

void add(ContentKey& key, const shared::Light& l) {
    add(key, l.position), add(key, l.direction), add(key, l.intensity);
    key.add(l.type);
    for (float value : {l.range, l.inner, l.outer, l.extent}) key.add(value);
}

} // namespace

// Rotate, mix and multiply, eight bytes at a time; the shift brings high bits down to where the next word
// enters.
void ContentKey::add_bytes(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    while (size > 0) {
        std::uint64_t word = 0;
        std::size_t count = size < 8 ? size : 8;
        std::memcpy(&word, bytes, count);
        state_ = (std::rotl(state_, 27) ^ word) * 0xbf58476d1ce4e5b9u;
        state_ ^= state_ >> 31;
        bytes += count, size -= count;
    }
}

std::uint64_t content_key(const Scene& scene) {
    ContentKey key;
    key.add(tracer_version);
    key.add(int(scene.brdf));
    for (std::size_t count : {scene.textures.size(), scene.materials.size(), scene.meshes.size(),
                              scene.instances.size(), scene.lights.size()})
        key.add(std::uint64_t(count));
    for (const Texture& t : scene.textures) add(key, t);
    for (const Material& m : scene.materials) add(key, m);
    for (const Mesh& m : scene.meshes) add(key, m);
    for (const Instance& i : scene.instances)
        key.add(i.mesh), key.add_bytes(&i.transform, sizeof i.transform);
    for (const shared::Light& l : scene.lights) add(key, l);
    const Environment& e = scene.environment;
    key.add(e.radiance.width), key.add(e.radiance.height);
    key.add(e.radiance.data), key.add(e.rotation), key.add(e.scale);
    return key.value();
}

std::uint64_t content_key(const Scene& scene, const ReferenceRequest& request) {
    ContentKey key;
    key.add(content_key(scene));
    key.add(request.width), key.add(request.height);
    for (const std::string& name : request.components) key.add(std::string_view(name));
    const Camera& c = request.camera;
    add(key, c.position), add(key, c.forward), add(key, c.up);
    for (float value : {c.yfov, c.near, c.far, request.settings.ao_radius}) key.add(value);
    if (c.orthographic()) key.add(c.half_height);
    const ReferenceSettings& s = request.settings;
    for (int value : {s.max_bounces, s.seed, int(s.pixel_center), int(s.ao_membership)}) key.add(value);

    // Settings that other components do not depend on must not part them from what is stored of them.
    const auto asks_for = [&](std::string_view prefix) {
        return std::any_of(request.components.begin(), request.components.end(),
                           [&](const std::string& name) { return name.starts_with(prefix); });
    };
    if (asks_for("reflections")) key.add(s.specular_depth), key.add(s.specular_roughness);
    if (asks_for("caustics")) {
        key.add(int(s.caustic_method)), key.add(s.specular_roughness);
        key.add(s.photons), key.add(s.photon_radius);
    }
    if (asks_for("full") || asks_for("specular")) {
        key.add(int(s.photon_lights));
        if (s.photon_lights != PhotonLights::none) key.add(s.photons), key.add(s.photon_radius);
    }
    return key.value();
}

} // namespace luxel
