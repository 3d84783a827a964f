// SPDX-License-Identifier: MIT
#include "techniques/frame/gpu_scene.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "core/error.h"
#include "scene/thin_sheets.h"
#include "techniques/frame/gpu_scene_params.h"
#include "techniques/frame/texture_upload.h"

namespace luxel {
namespace {

// Every device can bind this much as one storage buffer.
constexpr std::uint64_t largest_binding = std::uint64_t(128) << 20;

template <class T> gpu::Buffer upload_limited(gpu::Gpu& gpu, const Scene& scene, const std::vector<T>& values,
                                              std::string name) {
    std::uint64_t bytes = values.size() * sizeof(T);
    if (bytes > largest_binding)
        fail(Fault::resource, "{}: {}: {} MiB, more than the {} MiB that one GPU buffer holds", scene.name,
             name, bytes >> 20, largest_binding >> 20);
    return gpu.upload(std::span<const T>(values), std::move(name));
}

// Appends an optional attribute and returns its offset relative to the base vertex.
template <class T> int append(std::vector<T>& all, const std::vector<T>& values, int base_vertex) {
    if (values.empty()) return shared::ABSENT;
    int offset = int(all.size()) - base_vertex;
    all.insert(all.end(), values.begin(), values.end());
    return offset;
}

// Rows are cross products of the columns: inverse transpose up to a positive factor.
glm::mat3 normal_matrix(const glm::mat4& transform, float handedness) {
    glm::vec3 x(transform[0]), y(transform[1]), z(transform[2]);
    return glm::mat3(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y)) * handedness;
}

shared::InstanceRecord instance_record(const Instance& instance) {
    shared::InstanceRecord r{};
    r.object_to_world = instance.transform;
    r.handedness = handedness(instance.transform);
    r.normal_to_world = normal_matrix(instance.transform, r.handedness);
    return r;
}

Facing facing_of(const Scene& scene, const Instance& instance) {
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    if (!scene.materials[std::size_t(mesh.material)].looks_through_back()) return Facing::both;
    return handedness(instance.transform) < 0.0f ? Facing::mirrored_front : Facing::front;
}

Bounds world_bounds(const Bounds& box, const glm::mat4& transform) {
    Bounds world;
    if (box.empty()) return world;
    for (int i = 0; i < 8; ++i) {
        glm::vec3 corner((i & 1) ? box.most.x : box.least.x, (i & 2) ? box.most.y : box.least.y,
                         (i & 4) ? box.most.z : box.least.z);
        world.add(glm::vec3(transform * glm::vec4(corner, 1.0f)));
    }
    return world;
}

shared::TextureRecord texture_record(const Scene& scene, const TextureUse& use, bool mipmaps) {
    shared::TextureRecord r{};
    if (use.texture < 0) return r;
    const Texture& texture = scene.textures[std::size_t(use.texture)];
    glm::mat3 rows = glm::transpose(use.transform);
    r.u_row = rows[0], r.v_row = rows[1];
    r.size = {float(texture.pixels.width), float(texture.pixels.height)};
    r.wrap_u = shared::uint(texture.wrap_u), r.wrap_v = shared::uint(texture.wrap_v);
    r.set = shared::uint(use.set);
    r.present = 1;
    if (!mipmaps) r.filter_mode = texture.nearest ? shared::FILTER_NEAREST : shared::FILTER_BILINEAR;
    return r;
}
static_assert(shared::uint(Wrap::repeat) == shared::WRAP_REPEAT &&
              shared::uint(Wrap::clamp) == shared::WRAP_CLAMP &&
              shared::uint(Wrap::mirror) == shared::WRAP_MIRROR);

// The texture slots of a material, by the shader's names; those of core glTF first, the alpha test's before
// all.
constexpr std::size_t common_slots = 4;
struct TextureSlot {
    const char* name;
    TextureUse Material::*use;
    shared::TextureRecord shared::MaterialRecord::*record;
};
constexpr TextureSlot texture_slots[] = {
    {"base_color_texture", &Material::base_color_texture, &shared::MaterialRecord::base_color_texture},
    {"metallic_roughness_texture", &Material::metallic_roughness_texture,
     &shared::MaterialRecord::metallic_roughness_texture},
    {"normal_texture", &Material::normal_texture, &shared::MaterialRecord::normal_texture},
    {"emission_texture", &Material::emission_texture, &shared::MaterialRecord::emission_texture},
    {"specular_texture", &Material::specular_texture, &shared::MaterialRecord::specular_texture},
    {"specular_color_texture", &Material::specular_color_texture,
     &shared::MaterialRecord::specular_color_texture},
    {"transmission_texture", &Material::transmission_texture, &shared::MaterialRecord::transmission_texture},
};

shared::MaterialRecord material_record(const Scene& scene, const Material& m, bool mipmaps) {
    shared::MaterialRecord r{};
    r.base_color = m.base_color;
    r.emission = m.emission;
    r.metallic = m.metallic, r.roughness = m.roughness;
    r.normal_scale = m.normal_scale;
    r.ior = m.ior;
    r.specular = m.specular, r.specular_color = m.specular_color;
    r.transmission = m.transmission;
    if (m.alpha_mode != AlphaMode::opaque)
        r.alpha_cutoff = m.alpha_mode == AlphaMode::mask ? m.alpha_cutoff : 0.5f;
    r.blended = m.alpha_mode == AlphaMode::blend ? 1.0f : 0.0f;
    r.double_sided = m.double_sided ? 1 : 0;
    r.thin = m.thin ? 1 : 0;
    for (const TextureSlot& slot : texture_slots)
        r.*slot.record = texture_record(scene, m.*slot.use, mipmaps);
    r.height_texture = texture_record(scene, m.height_texture, mipmaps);
    r.height_scale = m.height_scale;
    r.clearcoat = m.clearcoat, r.clearcoat_roughness = m.clearcoat_roughness;
    r.multiple_scattering = scene.brdf == BrdfModel::multiple ? 1.0f : 0.0f;
    return r;
}

// What the texture's alpha is held against, where the material tests it: the factor is the same everywhere.
std::optional<float> mask_of(const Material& m) {
    const bool tested = m.alpha_mode == AlphaMode::mask && m.alpha_cutoff > 0.0f && m.base_color.a > 0.0f;
    return tested ? std::optional(m.alpha_cutoff / m.base_color.a) : std::nullopt;
}

} // namespace

GpuScene::GpuScene(gpu::Gpu& gpu, const Scene& scene, bool mipmaps) : scene_(&scene) {
    upload_geometry(gpu);
    upload_materials(gpu, mipmaps);
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        sheets_.push_back(may_be_clear_sheet(scene.materials[std::size_t(mesh.material)]));
        solids_.push_back(!sheets_.back());
    }
    if (std::find(sheets_.begin(), sheets_.end(), true) == sheets_.end()) sheets_.clear(), solids_.clear();
}

void GpuScene::upload_geometry(gpu::Gpu& gpu) {
    // All meshes behind one another; optional attributes take no memory where a mesh has none.
    std::vector<std::uint32_t> indices;
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents, colors;
    std::vector<glm::vec2> texcoords;
    for (const Mesh& mesh : scene_->meshes) {
        Place place{};
        place.first_index = std::uint32_t(indices.size());
        place.base_vertex = int(positions.size());
        indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
        positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
        normals.insert(normals.end(), mesh.normals.begin(), mesh.normals.end());
        place.uv0 = append(texcoords, mesh.texcoords[0], place.base_vertex);
        place.uv1 = append(texcoords, mesh.texcoords[1], place.base_vertex);
        place.tangent = append(tangents, mesh.tangents, place.base_vertex);
        place.color = append(colors, mesh.colors, place.base_vertex);
        for (glm::vec3 p : mesh.positions) place.bounds.add(p);
        places_.push_back(place);
    }

    indices_ = upload_limited(gpu, *scene_, indices, "indices");
    positions_ = upload_limited(gpu, *scene_, positions, "positions");
    normals_ = upload_limited(gpu, *scene_, normals, "normals");
    tangents_ = upload_limited(gpu, *scene_, tangents, "tangents");
    texcoords_ = upload_limited(gpu, *scene_, texcoords, "texcoords");
    colors_ = upload_limited(gpu, *scene_, colors, "colors");
    move_instances(gpu);
}

void GpuScene::move_instances(gpu::Gpu& gpu) {
    std::vector<glm::mat4> transforms;
    for (const Instance& instance : scene_->instances) transforms.push_back(instance.transform);
    if (version_ > 0 && transforms == transforms_) return;
    transforms_ = std::move(transforms), ++version_;

    // One draw for each instance, neighbors by material.
    std::vector<shared::InstanceRecord> records;
    objects_.clear(), bounds_ = {};
    for (const Instance& instance : scene_->instances) {
        const Mesh& mesh = scene_->meshes[std::size_t(instance.mesh)];
        const Place& place = places_[std::size_t(instance.mesh)];
        Object object{.bounds = world_bounds(place.bounds, instance.transform),
                      .draw = {.count = std::uint32_t(mesh.indices.size()),
                               .first = place.first_index,
                               .vertex_offset = place.base_vertex,
                               .instance = std::uint32_t(records.size())},
                      .material = mesh.material,
                      .facing = facing_of(*scene_, instance)};
        shared::InstanceRecord& r = records.emplace_back(instance_record(instance));
        r.uv0 = place.uv0, r.uv1 = place.uv1, r.tangent = place.tangent, r.color = place.color;
        if (mesh.indices.empty()) continue;
        objects_.push_back(object);
        bounds_.add(object.bounds.least), bounds_.add(object.bounds.most);
    }
    std::stable_sort(objects_.begin(), objects_.end(),
                     [](const Object& a, const Object& b) { return a.material < b.material; });
    instances_ = upload_limited(gpu, *scene_, records, "instances");
}

Bounds GpuScene::bounds_of(const std::vector<int>& instances) const {
    Bounds all;
    for (const Object& object : objects_) {
        if (std::find(instances.begin(), instances.end(), int(object.draw.instance)) == instances.end())
            continue;
        all.add(object.bounds.least), all.add(object.bounds.most);
    }
    return all;
}

void GpuScene::upload_materials(gpu::Gpu& gpu, bool mipmaps) {
    const std::byte white[4] = {std::byte{255}, std::byte{255}, std::byte{255}, std::byte{255}};
    gpu::Image no_texture = gpu.upload_image({.format = VK_FORMAT_R8G8B8A8_UNORM}, white, "no texture");
    std::map<std::pair<int, std::optional<float>>, gpu::Image> textures;
    auto bind = [&](const char* name, const TextureUse& use, std::optional<float> mask = {}) -> gpu::Binding {
        if (use.texture < 0) return {name, no_texture};
        const Texture& texture = scene_->textures[std::size_t(use.texture)];
        gpu::Image& image = textures[{use.texture, mask}];
        if (!image) image = upload_texture(gpu, texture, mipmaps, mask);
        return {name, image, texture.nearest ? gpu::Sampler::nearest_repeat : gpu::Sampler::linear_repeat};
    };
    for (const Material& m : scene_->materials) {
        // The last slot in use decides which shader it takes.
        std::size_t used = 0;
        for (std::size_t i = 0; i < std::size(texture_slots); ++i)
            if ((m.*texture_slots[i].use).texture >= 0) used = i + 1;
        MaterialOnGpu on_gpu{.masked = m.alpha_mode != AlphaMode::opaque, .kind = Surfaces::plain};
        if (used > 0) on_gpu.kind = mipmaps && used <= common_slots ? Surfaces::textured : Surfaces::full;

        shared::MaterialRecord record = material_record(*scene_, m, mipmaps);
        gpu::Binding material = {"material",
                                 gpu.upload(std::span<const shared::MaterialRecord>(&record, 1), m.name)};
        const gpu::Binding base_color = bind(texture_slots[0].name, m.*texture_slots[0].use, mask_of(m));
        const auto bind_slot = [&](const TextureSlot& slot) {
            return &slot == &texture_slots[0] ? base_color : bind(slot.name, m.*slot.use);
        };
        on_gpu.alpha = {material, base_color};
        on_gpu.all = {material};
        std::size_t bound = on_gpu.kind == Surfaces::plain      ? 0
                            : on_gpu.kind == Surfaces::textured ? common_slots
                                                                : std::size(texture_slots);
        for (std::size_t i = 0; i < bound; ++i) on_gpu.all.push_back(bind_slot(texture_slots[i]));
        if (m.has_relief()) {
            const gpu::Binding height = bind("height_texture", m.height_texture);
            on_gpu.displaced_alpha = on_gpu.alpha;
            on_gpu.displaced_alpha.push_back(height);
            on_gpu.displaced_all = {material, height};
            for (const TextureSlot& slot : texture_slots) on_gpu.displaced_all.push_back(bind_slot(slot));
        }
        materials_.push_back(std::move(on_gpu));
    }
}

std::vector<gpu::Batch> GpuScene::batches(const Frustum& frustum, Surfaces surfaces, MaterialUse use,
                                          const std::vector<bool>& drawn, bool apart, Facing facing) const {
    std::vector<gpu::Batch> batches;
    int last_material = -1;
    for (const Object& object : objects_) {
        const MaterialOnGpu& material = materials_[std::size_t(object.material)];
        if (!material.is(surfaces, apart) || (!drawn.empty() && !drawn[object.draw.instance])) continue;
        if (facing != Facing::any && object.facing != facing) continue;
        if (!touches(frustum, object.bounds)) continue;
        if (batches.empty() || (use != MaterialUse::none && object.material != last_material)) {
            gpu::Batch& batch = batches.emplace_back();
            if (use != MaterialUse::none) batch.bindings = material.bindings(surfaces, use);
            last_material = object.material;
        }
        batches.back().draws.push_back(object.draw);
    }
    return batches;
}

gpu::Bindings GpuScene::vertex_bindings(MaterialUse use) const {
    gpu::Bindings bindings = {{"positions", positions_}, {"instances", instances_}};
    if (use != MaterialUse::none) {
        bindings.push_back({"texcoords", texcoords_});
        bindings.push_back({"colors", colors_});
    }
    if (use == MaterialUse::all) {
        bindings.push_back({"normals", normals_});
        bindings.push_back({"tangents", tangents_});
    }
    return bindings;
}

} // namespace luxel
