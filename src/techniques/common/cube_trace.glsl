// SPDX-License-Identifier: MIT
// Rays through a layered distance cube: the closest hit of all layers, and the paths that go on from specular
// ones [Umenhoffer2009, alg. 3]. The including file defines SEARCH: NONE (by direction), PARALLAX, LINEAR,
// SECANT or BINARY.
#include "shared/brdf.h"
#include "techniques/common/cube_trace_params.h"
#define NONE 0
#define PARALLAX 1
#define LINEAR 2
#define SECANT 3
#define BINARY 4

layout(binding = 1) uniform samplerCubeArray radiance_map;
layout(binding = 2) uniform samplerCubeArray normal_map;
layout(binding = 3) uniform samplerCubeArray material_map; // nearest: kinds of surfaces do not mix
layout(binding = 4) uniform samplerCubeArray distance_map;
layout(binding = 5) uniform sampler2D ranges; // nearest and farthest distance of each layer

// Which side of specular surfaces the ray that is traced can meet: 1 = their fronts, -1 = their backs, from
// the inside of a solid. It also keeps rays from the surface that they start from.
float ray_side = 1.0;
int near_layer_count = 0;

float surface_distance(vec3 direction, int layer) {
    return textureLod(distance_map, vec4(direction, layer), 0.0).r;
}

bool surface_counts(vec3 p, vec3 r, int layer) {
    if (layer >= near_layer_count) return true;
    vec4 normal = textureLod(normal_map, vec4(p, layer), 0.0);
    return normal.a > 0.5 && dot(normal.xyz, r) * ray_side < 0.0;
}

vec3 surface_normal(vec3 direction, int layer) {
    return textureLod(normal_map, vec4(direction, layer), 0.0).xyz;
}

struct CubePoint {
    vec3 p; // relative to the center
    int layer;
    bool met;     // false: a guess
    bool escaped; // nothing is there: the ray leaves the scene
};

#if SEARCH <= PARALLAX
CubePoint trace_ray(CubeTraceParams c, vec3 x, vec3 r, bool inside) {
    int far = c.near_layers;
    return CubePoint(parallax_guess(x, r, far, SEARCH == PARALLAX ? c.search.refine : 0), far, false, false);
}
#else
CubePoint trace_ray(CubeTraceParams c, vec3 x, vec3 r, bool inside) {
    ray_side = inside ? -1.0 : 1.0;
    near_layer_count = c.near_layers;
    float closest = 1e30;
    int hit_layer = -1;
    bool hidden = false; // behind what the center sees when the ray leaves the last layer's range
    float start = 2.0 * c.search.texel * length(x);
    for (int layer = 0; layer < c.layers; ++layer) {
        vec2 limits = texelFetch(ranges, ivec2(layer, 0), 0).rg;
        RayRange range = range_between(x, r, limits.x * 0.999, limits.y * 1.001);
        range.first = max(range.first, start);
        range.last = min(range.last, closest);
        RayHit hit = search_layer(x, r, range, layer, SEARCH - LINEAR, c.search);
        if (hit.layer >= 0 && hit.d < closest) {
            closest = hit.d;
            hit_layer = layer;
        }
        hidden = range.last > range.first && overshoot(x + r * range.last, layer) > 0.0;
    }
    if (hit_layer >= 0) return CubePoint(x + r * closest, hit_layer, true, false);
    // A ray that ends in front of everything has left the scene. Behind what the center sees there may be anything: the
    // best guess is what is there from afar. The inside of a solid has an end, which was missed.
    return CubePoint(parallax_guess(x, r, c.near_layers, 2), c.near_layers, false, !hidden && !inside);
}
#endif

struct CubeRay {
    vec3 x; // relative to the center
    vec3 r;
    vec3 weight;
    bool inside; // of a solid
    int depth;   // specular surfaces behind it
};
struct CubeBranches {
    CubeRay reflected;
    CubeRay refracted; // weight 0: none
};

// What leaves a specular surface at x, whose normal is n and whose material is as DistanceCube has it. Weights are of
// radiance, or of a photon's power.
CubeBranches branch(CubeRay ray, vec3 x, vec3 n, vec4 material, bool radiance) {
    float facing = dot(n, ray.r);
    vec3 toward = facing < 0.0 ? n : -n;
    float cosine = abs(facing);
    CubeBranches b;
    b.reflected = CubeRay(x, reflect(ray.r, toward), ray.weight, ray.inside, ray.depth + 1);
    b.refracted = CubeRay(x, ray.r, vec3(0), ray.inside, ray.depth + 1);
    if (material.a < 0.0) {
        b.reflected.weight *= fresnel_schlick(material.rgb, vec3(1), cosine);
        return b;
    }
    // A thin sheet has its index in its reflectance alone. Radiance that enters a denser medium is compressed
    // into a smaller cone [Walter2007, section 5.2].
    bool thin = material.a == 1.0;
    float root = sqrt(clamp(material.r, 0.0, 0.9));
    float index = thin ? (1.0 + root) / (1.0 - root) : material.a;
    float eta = ray.inside ? 1.0 / index : index;
    float fresnel = fresnel_dielectric(cosine, eta);
    b.reflected.weight *= fresnel;
    b.refracted.weight = ray.weight * ((1.0 - fresnel) / (thin || !radiance ? 1.0 : eta * eta));
    if (thin) return b;
    b.refracted.r = refract(ray.r, toward, 1.0 / eta);
    b.refracted.inside = !ray.inside;
    return b;
}
