// SPDX-License-Identifier: MIT
// Every instance becomes one Embree geometry in world space: one level to traverse, and edges that meet in
// the scene meet bit for bit in the tree, so that the robust intersector leaves no cracks.
#include "scene/raycast.h"

#include <algorithm>
#include <vector>

#include <embree3/rtcore.h>

#include "core/error.h"
#include "scene/shading_mesh.h"
#include "scene/surface.h"
#include "scene/thin_sheets.h"

namespace luxel {
namespace {

// What the alpha filter of one geometry needs to know.
struct MaskedInstance {
    const Scene* scene;
    std::uint32_t instance;
};

// Rejects hits of texels below the cutoff.
void reject_transparent(const RTCFilterFunctionNArguments* arguments) {
    const auto& masked = *static_cast<const MaskedInstance*>(arguments->geometryUserPtr);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        std::uint32_t triangle = RTCHitN_primID(arguments->hit, arguments->N, i);
        glm::vec2 uv(RTCHitN_u(arguments->hit, arguments->N, i), RTCHitN_v(arguments->hit, arguments->N, i));
        if (is_transparent(*masked.scene, masked.instance, triangle, uv)) arguments->valid[i] = 0;
    }
}

// What is blended holds back a share of the light, which is not for a yes or no to say.
void reject_all(const RTCFilterFunctionNArguments* arguments) {
    for (unsigned i = 0; i < arguments->N; ++i) arguments->valid[i] = 0;
}

// A query that passes backs which cameras look through.
struct SeenContext {
    RTCIntersectContext embree; // first: Embree hands this address to the filter
    const std::vector<float>* winding;
    const std::vector<char>* one_sided;
};

// Rejects the backs of the instances that are seen from their front alone.
void reject_backs(const RTCFilterFunctionNArguments* arguments) {
    const auto& context = *reinterpret_cast<const SeenContext*>(arguments->context);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        const unsigned instance = RTCHitN_geomID(arguments->hit, arguments->N, i);
        if (!(*context.one_sided)[instance]) continue;
        const glm::vec3 normal(RTCHitN_Ng_x(arguments->hit, arguments->N, i),
                               RTCHitN_Ng_y(arguments->hit, arguments->N, i),
                               RTCHitN_Ng_z(arguments->hit, arguments->N, i));
        const glm::vec3 direction(RTCRayN_dir_x(arguments->ray, arguments->N, i),
                                  RTCRayN_dir_y(arguments->ray, arguments->N, i),
                                  RTCRayN_dir_z(arguments->ray, arguments->N, i));
        if (glm::dot(normal, direction) * (*context.winding)[instance] > 0.0f) arguments->valid[i] = 0;
    }
}

// Geometries by what a ray may be asked about.
constexpr unsigned solid_mask = 1, sheet_mask = 2;

RTCRay embree_ray(const Ray& ray, unsigned mask = ~0u) {
    RTCRay r;
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tnear = ray.t_min, r.tfar = ray.t_max;
    r.time = 0.0f;
    r.mask = mask;
    r.id = r.flags = 0;
    return r;
}

RTCScene robust_tree(RTCDevice device) {
    RTCScene tree = rtcNewScene(device);
    rtcSetSceneBuildQuality(tree, RTC_BUILD_QUALITY_HIGH);
    rtcSetSceneFlags(tree, RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    return tree;
}

} // namespace

struct RayCaster::Data {
    explicit Data(const Scene& s) : scene(&s) {}
    ~Data() {
        if (tree) rtcReleaseScene(tree);
        if (sheets) rtcReleaseScene(sheets);
        if (device) rtcReleaseDevice(device);
    }
    Data(const Data&) = delete;
    Data& operator=(const Data&) = delete;

    void add(std::uint32_t instance);
    void check(const char* what) const;
    bool nearest(RTCScene among, const RTCRay& ray, RTCIntersectContext* context, Hit& hit) const;

    const Scene* scene;
    RTCDevice device = nullptr;
    RTCScene tree = nullptr;
    RTCScene sheets = nullptr;          // what is pervious once more, by itself; none: nothing is
    std::vector<float> winding;         // per instance: -1 where the transform mirrors
    std::vector<char> one_sided;        // per instance: cameras look through its backs
    std::vector<MaskedInstance> masked; // per instance, for the filters
    std::vector<ShadingMesh> shading;   // per instance
};

void RayCaster::Data::check(const char* what) const {
    RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE)
        fail(Fault::resource, "{}: ray casting: {} failed (Embree error {}); is there enough memory?",
             scene->name, what, int(error));
}

void RayCaster::Data::add(std::uint32_t index) {
    const Instance& instance = scene->instances[index];
    const Mesh& mesh = scene->meshes[std::size_t(instance.mesh)];
    winding[index] = handedness(instance.transform);
    one_sided[index] = scene->materials[std::size_t(mesh.material)].looks_through_back();
    if (mesh.indices.empty()) return;
    shading[index] = shading_mesh(*scene, index);

    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
    check("memory for vertices");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        vertices[i] = transform_point(instance.transform, mesh.positions[i]);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0,
                               3 * sizeof(std::uint32_t), mesh.indices.size() / 3);

    // A filter costs time on every candidate hit: only geometries that may have holes get one.
    if (scene->materials[std::size_t(mesh.material)].alpha_mode != AlphaMode::opaque) {
        masked[index] = {scene, index};
        rtcSetGeometryUserData(geometry, &masked[index]);
        rtcSetGeometryIntersectFilterFunction(geometry, reject_transparent);
        const bool blended = scene->materials[std::size_t(mesh.material)].alpha_mode == AlphaMode::blend;
        rtcSetGeometryOccludedFilterFunction(geometry, blended ? reject_all : reject_transparent);
    }
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    const Material& material = scene->materials[std::size_t(mesh.material)];
    const bool sheet = may_be_clear_sheet(material) || material.alpha_mode == AlphaMode::blend;
    rtcSetGeometryMask(geometry, sheet ? sheet_mask : solid_mask);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(tree, geometry, index);
    if (sheet) {
        if (!sheets) sheets = robust_tree(device);
        rtcAttachGeometryByID(sheets, geometry, index);
    }
    rtcReleaseGeometry(geometry);
    check("adding a mesh");
}

RayCaster::RayCaster(const Scene& scene) : data_(std::make_unique<Data>(scene)) {
    data_->device = rtcNewDevice(nullptr);
    if (!data_->device)
        fail(Fault::resource, "{}: ray casting: Embree has no device on this processor", scene.name);
    data_->tree = robust_tree(data_->device);
    data_->winding.resize(scene.instances.size());
    data_->one_sided.resize(scene.instances.size());
    data_->masked.resize(scene.instances.size());
    data_->shading.resize(scene.instances.size());
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) data_->add(i);
    rtcCommitScene(data_->tree);
    if (data_->sheets) rtcCommitScene(data_->sheets);
    data_->check("building the tree");
}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

bool RayCaster::Data::nearest(RTCScene among, const RTCRay& ray, RTCIntersectContext* context,
                              Hit& hit) const {
    RTCRayHit query;
    query.ray = ray;
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(among, context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    hit.t = query.ray.tfar;
    hit.instance = query.hit.geomID;
    hit.triangle = query.hit.primID;
    hit.u = query.hit.u, hit.v = query.hit.v;
    hit.geometric_normal = glm::vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z) * winding[hit.instance];
    hit.shading = &shading[hit.instance];
    prefetch(*hit.shading, hit.triangle);
    return true;
}

bool RayCaster::intersect(const Ray& ray, Hit& hit) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    return data_->nearest(data_->tree, embree_ray(ray), &context, hit);
}

bool RayCaster::intersect_seen(const Ray& ray, Hit& hit) const {
    // Most rays meet fronts, which need no filter. (Starting again behind a back would miss a front that lies
    // in its plane, as where two surfaces stand back to back.)
    if (!intersect(ray, hit)) return false;
    if (!data_->one_sided[hit.instance] || glm::dot(hit.geometric_normal, ray.direction) <= 0.0f) return true;
    SeenContext context;
    rtcInitIntersectContext(&context.embree);
    context.embree.filter = reject_backs;
    context.winding = &data_->winding, context.one_sided = &data_->one_sided;
    return data_->nearest(data_->tree, embree_ray(ray), &context.embree, hit);
}

bool RayCaster::occluded(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query = embree_ray(ray);
    rtcOccluded1(data_->tree, &context, &query);
    return query.tfar < 0.0f; // Embree's mark for "something is in the way"
}

glm::vec3 RayCaster::transmitted(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay solid = embree_ray(ray, data_->sheets ? solid_mask : ~0u);
    rtcOccluded1(data_->tree, &context, &solid);
    if (solid.tfar < 0.0f) return glm::vec3(0.0f);

    // The sheets in their order along the ray. Each is met once: the next query begins behind it by some
    // roundings of its distance, more than Embree's comparison errs by.
    constexpr float behind = 1.0f + 0x1p-20f;
    glm::vec3 share(1.0f);
    Ray rest = ray;
    Hit hit;
    while (data_->sheets && data_->nearest(data_->sheets, embree_ray(rest), &context, hit)) {
        share *= straight_transmittance(surface_at(*data_->scene, hit, ray.direction), ray.direction);
        if (share == glm::vec3(0.0f)) break;
        rest.t_min = std::max(hit.t * behind, 1e-30f);
    }
    return share;
}

const Scene& RayCaster::scene() const { return *data_->scene; }
void* RayCaster::embree_scene() const { return data_->tree; }

} // namespace luxel
