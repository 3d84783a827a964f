// SPDX-License-Identifier: MIT
// Shading normals against the geometric surface: interpolation and normal maps turn normals so far that
// mirrored rays and parts of the lobes would lie below it. What is done about that keeps all energy.
#ifndef LUXEL_SHARED_HORIZON_H
#define LUXEL_SHARED_HORIZON_H
#include "shared/glsl.h"
LUXEL_BEGIN

// A shading normal that interpolation or a normal map turned away is bent back, so that it lies in the
// hemispheres of the geometric normal ng and of the direction to the viewer wo (both on one side: dot(ng, wo)
// >= 0).
LUXEL_CONST float LEAST_FACING_COSINE = 0.01f;
LUXEL_FN vec3 facing_normal(vec3 n, vec3 ng, vec3 wo) {
    float c = dot(n, ng);
    if (c < LEAST_FACING_COSINE) n = normalize(n + ng * (LEAST_FACING_COSINE - c));
    c = dot(n, wo);
    if (c < LEAST_FACING_COSINE) n = normalize(n + wo * (LEAST_FACING_COSINE - c));
    return n;
}

// The normal nearest to n, on the way to ng, in which wo is mirrored to a direction that is above the
// geometric surface by LEAST_REFLECTED_COSINE, or as far as wo itself.
//
// Let n' = ng cos x + t sin x with t the unit direction of n across ng, a = ng.wo and b = t.wo. The mirrored
// direction r = 2 (n'.wo) n' - wo has r.ng = a cos 2x + b sin 2x = rho cos(2x - d), with rho^2 = a^2 + b^2
// and d the angle of (a, b). It is a at x = 0, so that r.ng >= c, with c <= a, holds up to 2x = d + acos(c /
// rho). Then n'.wo > 0 as well, since 2 (n'.wo) (n'.ng) = r.ng + a. (Blender's Cycles asks for the same and
// solves a quadratic equation for the normal's coordinates.)
LUXEL_CONST float LEAST_REFLECTED_COSINE = 0.01f;
LUXEL_FN vec3 reflecting_normal(vec3 n, vec3 ng, vec3 wo) {
    float a = dot(ng, wo);
    float c = min(a, LEAST_REFLECTED_COSINE);
    float on_ng = dot(n, ng);
    if (on_ng > 0.0f && 2.0f * dot(n, wo) * on_ng - a >= c) return n;
    vec3 t = n - ng * on_ng;
    float across = length(t);
    if (across < 1e-6f) return ng;
    t = t / across;
    float b = dot(t, wo);
    float rho2 = max(a * a + b * b, 1e-20f);
    float cos_2x = clamp((a * c - b * sqrt(max(rho2 - c * c, 0.0f))) / rho2, -1.0f, 1.0f);
    return normalize(ng * sqrt(0.5f + 0.5f * cos_2x) + t * sqrt(0.5f - 0.5f * cos_2x));
}

// The share of a surface that has no diffuse lobe; transmission: of what is not metallic or of all of it.
LUXEL_FN float share_without_diffuse(float metallic, float transmission) {
    return 1.0f - (1.0f - metallic) * (1.0f - transmission);
}

// The normal that a surface is shaded with. Only what mirrors or transmits asks for the stronger bend, which
// depends on the view: `specular` is the share of the surface that has no diffuse lobe.
LUXEL_FN vec3 bent_normal(vec3 n, vec3 ng, vec3 wo, float specular) {
    vec3 facing = facing_normal(n, ng, wo);
    return specular > 0.0f ? normalize(mix(facing, reflecting_normal(n, ng, wo), specular)) : facing;
}

// Directions that a lobe has below the geometric horizon are mirrored to above it.
LUXEL_FN vec3 mirrored_at_horizon(vec3 w, vec3 ng) { return w - ng * (2.0f * dot(w, ng)); }
LUXEL_FN vec3 above_horizon(vec3 w, vec3 ng) { return dot(w, ng) < 0.0f ? mirrored_at_horizon(w, ng) : w; }

// The Lambertian lobe around n has (1 - n.ng) / 2 of its light below the horizon of ng (the projection of a half disc
// minus that of half an ellipse). That share is lost, as in other renderers: what a lamp above the horizon gives to a
// mapped surface is n.l, which files rely on.

LUXEL_END
#endif
