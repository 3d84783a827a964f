// SPDX-License-Identifier: MIT
#include "techniques/vpl/ism.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/error.h"
#include "scene/surface.h"
#include "shared/random.h"

namespace luxel {

void IsmOptions::visit(Visitor& v) {
    v.integer("ism_size", size, {8, 256},
              "texels a side of each light's imperfect shadow map; the next power of two");
    v.integer("ism_points", points, {64, 65536}, "points that each imperfect shadow map is drawn with");
}

namespace {

constexpr int sets_of_points = 8;
constexpr std::uint32_t fill_levels = 2; // holes of up to 4 texels

struct Triangle {
    std::uint32_t instance, index;
    glm::vec3 corners[3]; // object space
    double area;          // world
};

std::vector<Triangle> triangles_of(const Scene& scene) {
    std::vector<Triangle> all;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Mesh& mesh = scene.meshes[std::size_t(scene.instances[i].mesh)];
        const glm::mat3 to_world(scene.instances[i].transform);
        for (std::uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
            Triangle& triangle = all.emplace_back(Triangle{.instance = i, .index = t});
            for (std::size_t k = 0; k < 3; ++k) triangle.corners[k] = mesh.positions[mesh.indices[3 * t + k]];
            const glm::vec3 *c = triangle.corners, a = to_world * (c[1] - c[0]), b = to_world * (c[2] - c[0]);
            triangle.area = 0.5 * double(glm::length(glm::cross(a, b)));
        }
    }
    return all;
}

// Uniform on the triangle, from a point of the unit square: barycentric weights of corners 1 and 2.
glm::vec2 on_triangle(glm::vec2 u) {
    const float root = std::sqrt(u.x);
    return {root * (1.0f - u.y), root * u.y};
}

} // namespace

// Systematic sampling: one point in each share of the summed area. Neighbors on it go to different sets.
// Holes of alpha masks have no points, and are area nevertheless.
IsmPoints ism_points(gpu::Gpu& gpu, const Scene& scene, const IsmOptions& options) {
    const std::vector<Triangle> triangles = triangles_of(scene);
    double area = 0.0;
    for (const Triangle& t : triangles) area += t.area;
    IsmPoints result{.sets = sets_of_points, .count = options.points, .area = float(area)};
    const std::size_t wanted = std::size_t(result.sets * result.count);
    std::vector<shared::IsmPoint> points(wanted, shared::IsmPoint{});
    double before = 0.0;
    std::size_t next = 0;
    for (const Triangle& t : triangles) {
        before += t.area;
        for (; next < wanted && (double(next) + 0.5) / double(wanted) * area < before; ++next) {
            const std::size_t set = next % std::size_t(result.sets), place = next / std::size_t(result.sets);
            const glm::dvec2 u = glm::fract(double(place) * glm::dvec2(0.7548776662467, 0.5698402909980) +
                                            double(set) * 0.6180339887499); // [Roberts2018]
            const glm::vec2 uv = on_triangle(glm::vec2(u));
            const float draw = shared::uniform_float(shared::hash2(shared::uint(next), 77u));
            if (draw >= coverage_at(scene, t.instance, t.index, uv)) continue;
            const glm::vec3 *c = t.corners, a = c[1] - c[0], b = c[2] - c[0];
            points[set * std::size_t(result.count) + place] = {c[0] + a * uv.x + b * uv.y, t.instance,
                                                               glm::cross(a, b)};
        }
    }
    result.points = gpu.upload(std::span<const shared::IsmPoint>(points), "ism points");
    return result;
}

IsmMaps imperfect_shadow_maps(gpu::Recorder& recorder, const Frame& frame, const IsmPoints& points,
                              const Vpls& vpls, const IsmOptions& options) {
    auto scope = recorder.scope("ism");
    IsmMaps ism;
    shared::IsmParams& p = ism.params;
    p.size = int(std::bit_ceil(unsigned(options.size)));
    p.columns = std::max(int(std::ceil(std::sqrt(double(vpls.most)))), 1);
    p.points = points.count, p.sets = points.sets;
    p.radius = std::sqrt(points.area / (shared::PI * float(points.count)));

    // Where the points are now.
    const std::uint32_t all = std::uint32_t(points.count * points.sets);
    const gpu::Buffer placed = recorder.gpu().buffer(all * 2 * sizeof(glm::vec4), "ism placed points");
    gpu::Bindings bindings = {{"points", points.points}, {"placed", placed}};
    for (const gpu::Binding& b : frame.scene->vertex_bindings(MaterialUse::none))
        if (b.name == "instances") bindings.push_back(b);
    recorder.dispatch("vpl/ism_points.comp", {all}, gpu::Recorder::NoParams{}, bindings);

    // Nearest of them in each texel, then what the holes between them may show.
    constexpr int most_side = 16384; // of an image on any device
    if (p.columns * p.size > most_side)
        fail(Fault::usage,
             "vpl: {} virtual point lights with maps of {}x{} texels need an image of more than {} "
             "texels a side; take fewer vpls or a lower ism_size",
             vpls.most, p.size, p.size, most_side);
    const std::uint32_t side = std::uint32_t(p.columns * p.size);
    const gpu::Image nearest =
        recorder.image({.width = side, .height = side, .format = VK_FORMAT_R32_UINT}, "ism nearest");
    recorder.clear(nearest, {});
    recorder.dispatch(
        "vpl/ism_splat.comp", {std::uint32_t(p.points), std::uint32_t(vpls.most)}, p,
        {{"placed", placed}, {"lights", vpls.lights}, {"light_count", vpls.count}, {"nearest", nearest}});
    const gpu::Image maps = recorder.image(
        {.width = side, .height = side, .format = VK_FORMAT_R32_SFLOAT, .mips = fill_levels + 1}, "ism");
    recorder.dispatch("vpl/ism_pull_first.comp", extent_of(maps.mip(1)), gpu::Recorder::NoParams{},
                      {{"nearest", nearest}, {"fine", maps.mip(0)}, {"coarse", maps.mip(1)}});
    for (std::uint32_t level = 2; level <= fill_levels; ++level)
        recorder.dispatch("vpl/ism_pull.comp", extent_of(maps.mip(level)), gpu::Recorder::NoParams{},
                          {{"fine", maps.mip(level - 1)}, {"coarse", maps.mip(level)}});
    for (std::uint32_t level = fill_levels; level > 0; --level)
        recorder.dispatch("vpl/ism_push.comp", extent_of(maps.mip(level - 1)), gpu::Recorder::NoParams{},
                          {{"coarse", maps.mip(level)}, {"fine", maps.mip(level - 1)}});
    ism.maps = maps.mip(0);
    return ism;
}

} // namespace luxel
