// SPDX-License-Identifier: MIT
#include "techniques/frame/impostor_cloud.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "techniques/frame/capture.h"
#include "techniques/frame/gbuffer.h"
#include "techniques/frame/impostor_planes.h"
#include "techniques/frame/projection.h"

namespace luxel {
namespace {

constexpr std::uint32_t largest_side = 8192; // of the image; every device has such images
constexpr float least_relative_distance = 1e-5f;

// The object's triangles in world space, and where each comes from.
struct Triangles {
    struct Source {
        int instance;
        std::uint32_t first; // of its indices in the mesh
    };
    std::vector<glm::vec3> corners; // three each
    std::vector<Source> sources;
    Bounds bounds;
};

Triangles world_triangles(const Scene& scene, const ImpostorObject& object) {
    Triangles all;
    for (int i : object.instances) {
        const Instance& instance = scene.instances[std::size_t(i)];
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        for (std::size_t k = 0; k < mesh.indices.size(); ++k) {
            const glm::vec3 p = mesh.positions[mesh.indices[k]];
            all.corners.push_back(glm::vec3(instance.transform * glm::vec4(p, 1.0f)));
            all.bounds.add(all.corners.back());
            if (k % 3 == 0) all.sources.push_back({i, std::uint32_t(k)});
        }
    }
    return all;
}

// Axes in the plane along which its points spread most and least, and the rectangle around them.
struct Rectangle {
    glm::vec3 u, v, center; // cross(u, v) is the plane's normal
    glm::vec2 extent;       // meters
};
Rectangle rectangle_of(const ImpostorPlane& plane, const std::vector<glm::vec3>& corners) {
    const glm::vec3 n = plane.normal;
    const glm::vec3 a =
        glm::normalize(glm::cross(n, std::abs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
    const glm::vec3 b = glm::cross(n, a);
    const auto each = [&](auto&& visit) {
        for (std::uint32_t t : plane.triangles)
            for (std::size_t k = 0; k < 3; ++k) visit(corners[3 * t + k]);
    };
    glm::vec2 mean(0.0f);
    each([&](glm::vec3 p) { mean += glm::vec2(glm::dot(a, p), glm::dot(b, p)); });
    mean /= float(3 * plane.triangles.size());
    float xx = 0.0f, xy = 0.0f, yy = 0.0f;
    each([&](glm::vec3 p) {
        const glm::vec2 d = glm::vec2(glm::dot(a, p), glm::dot(b, p)) - mean;
        xx += d.x * d.x, xy += d.x * d.y, yy += d.y * d.y;
    });
    const float angle = 0.5f * std::atan2(2.0f * xy, xx - yy);
    Rectangle r;
    r.u = a * std::cos(angle) + b * std::sin(angle), r.v = glm::cross(n, r.u);

    glm::vec2 least(1e30f), most(-1e30f);
    each([&](glm::vec3 p) {
        const glm::vec2 at(glm::dot(r.u, p), glm::dot(r.v, p));
        least = glm::min(least, at), most = glm::max(most, at);
    });
    r.extent = most - least;
    const glm::vec2 middle = (least + most) * 0.5f;
    r.center = r.u * middle.x + r.v * middle.y + n * plane.offset;
    return r;
}

struct Size {
    std::uint32_t x, y;
};

// Rows of rectangles, the highest first. Returns the size of the whole.
Size pack(const std::vector<Size>& sizes, std::vector<Size>& places) {
    std::vector<std::size_t> order(sizes.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return sizes[a].y > sizes[b].y; });
    double area = 0.0;
    Size whole{1, 0}, next{0, 0};
    for (Size s : sizes) area += double(s.x) * s.y, whole.x = std::max(whole.x, s.x);
    whole.x = std::max(whole.x, std::uint32_t(std::ceil(std::sqrt(area))));
    places.resize(sizes.size());
    for (std::size_t i : order) {
        if (next.x + sizes[i].x > whole.x) next = {0, whole.y};
        places[i] = next;
        next.x += sizes[i].x;
        whole.y = std::max(whole.y, next.y + sizes[i].y);
    }
    return whole;
}

// From a view that fills its image to one that fills a part of a larger one.
glm::mat4 into_part(Size place, Size size, Size whole) {
    const glm::vec2 w(float(whole.x), float(whole.y)), s(float(size.x), float(size.y));
    const glm::vec2 p(float(place.x), float(place.y));
    glm::mat4 m(1.0f);
    m[0][0] = s.x / w.x, m[3][0] = (2.0f * p.x + s.x) / w.x - 1.0f;
    m[1][1] = s.y / w.y, m[3][1] = 1.0f - (2.0f * p.y + s.y) / w.y;
    return m;
}

void check(const Scene& scene, const ImpostorObject& object, const Bounds& bounds) {
    for (int i : object.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(scene.instances[std::size_t(i)].mesh)];
        if (scene.materials[std::size_t(mesh.material)].has_relief())
            fail(Fault::bad_input,
                 "{}: object \"{}\": a billboard_cloud cannot show a height map; make it a nailboard",
                 scene.name, object.name);
    }
    if (object.impostor.distance < least_relative_distance * bounds.radius())
        fail(Fault::bad_input, "{}: object \"{}\": impostor_distance {} m is too small for an object of {} m",
             scene.name, object.name, object.impostor.distance, 2.0f * bounds.radius());
}

// One part for each instance in the plane.
std::vector<ImpostorCloud::Part> append_parts(const Scene& scene, const Triangles& all,
                                              const ImpostorPlane& plane,
                                              std::vector<std::uint32_t>& indices) {
    std::vector<ImpostorCloud::Part> parts;
    for (std::uint32_t t : plane.triangles) {
        const Triangles::Source& source = all.sources[t];
        if (parts.empty() || parts.back().instance != source.instance)
            parts.push_back({source.instance, std::uint32_t(indices.size()), 0});
        const Instance& instance = scene.instances[std::size_t(source.instance)];
        const std::uint32_t* corner = &scene.meshes[std::size_t(instance.mesh)].indices[source.first];
        indices.insert(indices.end(), corner, corner + 3);
        parts.back().count += 3;
    }
    return parts;
}

} // namespace

ImpostorCloud make_cloud(const Scene& scene, const ImpostorObject& object) {
    const Triangles all = world_triangles(scene, object);
    ImpostorCloud cloud;
    if (all.corners.empty()) return cloud;
    check(scene, object, all.bounds);
    const std::vector<ImpostorPlane> planes = choose_planes(all.corners, object.impostor.distance);

    // All planes at one density of texels, with a rim of one.
    const glm::vec3 side = all.bounds.most - all.bounds.least;
    const float texel = std::max({side.x, side.y, side.z}) / float(object.impostor.size);
    std::vector<Rectangle> rectangles;
    std::vector<Size> sizes, places;
    for (const ImpostorPlane& plane : planes) {
        const Rectangle& r = rectangles.emplace_back(rectangle_of(plane, all.corners));
        sizes.push_back({std::uint32_t(r.extent.x / texel) + 3, std::uint32_t(r.extent.y / texel) + 3});
    }
    const Size whole = pack(sizes, places);
    if (whole.x > largest_side || whole.y > largest_side)
        fail(Fault::resource,
             "{}: object \"{}\": its {} billboards need {}x{} texels, more than {}x{}; lower impostor_size "
             "or raise "
             "impostor_distance",
             scene.name, object.name, planes.size(), whole.x, whole.y, largest_side, largest_side);
    cloud.width = whole.x, cloud.height = whole.y;

    // Each is seen along its normal from beyond the triangles; rounding gets a hundredth.
    const float reach = object.impostor.distance * 1.01f;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const Rectangle& r = rectangles[i];
        const glm::vec2 size(float(sizes[i].x), float(sizes[i].y)), half = size * (0.5f * texel);
        const glm::vec3 right = r.u * half.x, up = r.v * half.y, n = planes[i].normal;
        shared::ViewParams view =
            parallel_view_params({r.center + n * reach, -n, right, up}, 2.0f * reach, size);
        cloud.cards.push_back({.corner = r.center - right + up,
                               .edge_u = right * 2.0f,
                               .edge_v = up * -2.0f,
                               .first = {float(places[i].x), float(places[i].y)},
                               .size = size,
                               .eye = view.position,
                               .forward = -n,
                               .depth = reach,
                               .turn = glm::mat3(1.0f),
                               .parallel = 1.0f});
        view.world_to_clip = into_part(places[i], sizes[i], whole) * view.world_to_clip;
        cloud.views.push_back(view);
        cloud.parts.push_back(append_parts(scene, all, planes[i], cloud.indices));
    }
    return cloud;
}

std::optional<glm::mat4> common_motion(const std::vector<glm::mat4>& before,
                                       const std::vector<glm::mat4>& after) {
    // What rounding leaves of a rotation and of equality, relative to the numbers at hand.
    constexpr double rounding = 1e-4;
    std::optional<glm::dmat4> motion;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const glm::dmat4 m = glm::dmat4(after[i]) * glm::inverse(glm::dmat4(before[i]));
        if (!motion) motion = m;
        for (int column = 0; column < 4; ++column) {
            const double size = std::max(1.0, glm::length((*motion)[column]));
            if (!(glm::length(m[column] - (*motion)[column]) <= rounding * size)) return std::nullopt;
        }
    }
    const glm::dmat3 turn(*motion), deviation = glm::transpose(turn) * turn - glm::dmat3(1.0);
    for (int column = 0; column < 3; ++column)
        if (!(glm::length(deviation[column]) <= rounding)) return std::nullopt;
    if (glm::determinant(turn) < 0.0) return std::nullopt;
    return glm::mat4(*motion);
}

std::vector<shared::ImpostorCard> moved(std::vector<shared::ImpostorCard> cards, const glm::mat4& motion) {
    const auto move = [&](glm::vec3& v, float w) { v = glm::vec3(motion * glm::vec4(v, w)); };
    for (shared::ImpostorCard& card : cards) {
        move(card.corner, 1.0f), move(card.eye, 1.0f);
        move(card.edge_u, 0.0f), move(card.edge_v, 0.0f), move(card.forward, 0.0f);
        card.turn = glm::mat3(motion) * card.turn;
    }
    return cards;
}

Capture draw_cloud(gpu::Recorder& recorder, const GpuScene& scene, const ImpostorObject& object,
                   const ImpostorCloud& cloud) {
    shared::ViewParams whole = cloud.views.at(0);
    whole.width = float(cloud.width), whole.height = float(cloud.height);
    Capture c = capture_images(recorder, scene, {.view = whole, .prefix = "impostor " + object.name + " "});
    gpu::RasterPass pass = gbuffer_pass(c);
    const gpu::Buffer indices =
        recorder.gpu().upload(std::span<const std::uint32_t>(cloud.indices), "impostor indices");

    std::vector<bool> drawn(scene.scene().instances.size());
    for (int i : object.instances) drawn[std::size_t(i)] = true;
    for (const SurfaceProgram& program : surface_programs) {
        const std::vector<gpu::Batch> whole_meshes =
            scene.batches(Frustum{}, program.surfaces, MaterialUse::all, drawn);
        for (std::size_t plane = 0; plane < cloud.cards.size(); ++plane) {
            std::vector<gpu::Batch> batches;
            for (const gpu::Batch& meshes : whole_meshes) {
                gpu::Batch batch{.bindings = meshes.bindings, .draws = {}};
                for (gpu::Draw draw : meshes.draws)
                    for (const ImpostorCloud::Part& part : cloud.parts[plane])
                        if (part.instance == int(draw.instance)) {
                            draw.first = part.first, draw.count = part.count;
                            batch.draws.push_back(draw);
                        }
                if (!batch.draws.empty()) batches.push_back(std::move(batch));
            }
            if (batches.empty()) continue;
            recorder.draw(program.program, pass, cloud.views[plane], scene.vertex_bindings(MaterialUse::all),
                          indices, batches);
            load_targets(pass);
        }
    }
    return c;
}

} // namespace luxel
