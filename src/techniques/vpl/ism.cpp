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
    glm::vec3 corners[3];                       // object space
    glm::vec2 uv[3] = {{0, 0}, {1, 0}, {0, 1}}; // of the corners, in the mesh's triangle
    double weight = 0.0;                        // area, over the squared distance from the eye
    float density = 0.0f;                       // weight by area
};

// Density of points around an eye, up to a factor.
struct Nearness {
    std::optional<glm::vec3> eye;
    float near;
    float at(glm::vec3 p) const {
        const glm::vec3 d = eye ? p - *eye : glm::vec3(0);
        return eye ? 1.0f / (glm::dot(d, d) + near * near) : 1.0f;
    }
};

// Cuts a triangle in two across its longest side until its density is nearly that of its middle.
void add_pieces(std::vector<Triangle>& all, const Triangle& t, const glm::mat4& to_world,
                const Nearness& near, int most_cuts) {
    glm::vec3 world[3];
    for (int k = 0; k < 3; ++k) world[k] = glm::vec3(to_world * glm::vec4(t.corners[k], 1.0f));
    const float density = near.at((world[0] + world[1] + world[2]) / 3.0f);
    float least = density, most = density;
    for (glm::vec3 p : world) least = std::min(least, near.at(p)), most = std::max(most, near.at(p));
    if (most_cuts == 0 || most <= 2.0f * least) {
        all.push_back(t);
        const float area = 0.5f * glm::length(glm::cross(world[1] - world[0], world[2] - world[0]));
        all.back().density = density, all.back().weight = double(area) * double(density);
        return;
    }
    int longest = 0;
    auto side = [&](int k) { return glm::length(world[(k + 1) % 3] - world[k]); };
    for (int k = 1; k < 3; ++k) longest = side(k) > side(longest) ? k : longest;
    const int a = longest, b = (longest + 1) % 3;
    for (int kept : {a, b}) {
        Triangle half = t;
        const int moved = kept == a ? b : a;
        half.corners[moved] = 0.5f * (t.corners[a] + t.corners[b]);
        half.uv[moved] = 0.5f * (t.uv[a] + t.uv[b]);
        add_pieces(all, half, to_world, near, most_cuts - 1);
    }
}

std::vector<Triangle> triangles_of(const Scene& scene, const Nearness& near) {
    constexpr int most_cuts = 12;
    std::vector<Triangle> all;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Mesh& mesh = scene.meshes[std::size_t(scene.instances[i].mesh)];
        for (std::uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
            Triangle triangle{.instance = i, .index = t};
            for (std::size_t k = 0; k < 3; ++k) triangle.corners[k] = mesh.positions[mesh.indices[3 * t + k]];
            add_pieces(all, triangle, scene.instances[i].transform, near, most_cuts);
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

float ism_near(const Scene& scene) { return scene.bounds().radius() / 8.0f; }

// Systematic sampling: one point in each share of the summed weight. Neighbors on it go to different sets.
// Holes of alpha masks have no points, and are area nevertheless.
IsmPoints ism_points(gpu::Gpu& gpu, const Scene& scene, const IsmOptions& options,
                     std::optional<glm::vec3> eye) {
    const std::vector<Triangle> triangles = triangles_of(scene, {eye, ism_near(scene)});
    double weight = 0.0;
    for (const Triangle& t : triangles) weight += t.weight;
    IsmPoints result{.sets = sets_of_points, .count = options.points};
    const std::size_t wanted = std::size_t(result.sets * result.count);
    std::vector<shared::IsmPoint> points(wanted, shared::IsmPoint{});
    double before = 0.0;
    std::size_t next = 0;
    for (const Triangle& t : triangles) {
        before += t.weight;
        for (; next < wanted && (double(next) + 0.5) / double(wanted) * weight < before; ++next) {
            const std::size_t set = next % std::size_t(result.sets), place = next / std::size_t(result.sets);
            const glm::dvec2 u = glm::fract(double(place) * glm::dvec2(0.7548776662467, 0.5698402909980) +
                                            double(set) * 0.6180339887499); // [Roberts2018]
            const glm::vec2 at = on_triangle(glm::vec2(u));
            const glm::vec2 uv = t.uv[0] + (t.uv[1] - t.uv[0]) * at.x + (t.uv[2] - t.uv[0]) * at.y;
            const float draw = shared::uniform_float(shared::hash2(shared::uint(next), 77u));
            if (draw >= coverage_at(scene, t.instance, t.index, uv)) continue;
            const glm::vec3 *c = t.corners, a = c[1] - c[0], b = c[2] - c[0];
            const float area = float(weight) / (t.density * float(options.points));
            points[set * std::size_t(result.count) + place] = {
                c[0] + a * at.x + b * at.y, t.instance, std::sqrt(area / shared::PI), glm::cross(a, b)};
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
