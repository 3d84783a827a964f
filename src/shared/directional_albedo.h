// SPDX-License-Identifier: MIT
// What the GGX lobe reflects of light that is the same from everywhere, by the view's cosine and the lobe's
// width. The integrals have no closed form: these are polynomials fitted to them (least squares, weighted
// until the largest error no longer fell).
#ifndef LUXEL_SHARED_DIRECTIONAL_ALBEDO_H
#define LUXEL_SHARED_DIRECTIONAL_ALBEDO_H
#include "shared/glsl.h"
LUXEL_BEGIN

// A lobe with Schlick's Fresnel term reflects f0 (whole - grazing) + f90 grazing.
struct DirectionalAlbedo {
    float whole;   // of facets that reflect everything; what is missing to 1 would hit another facet
    float grazing; // the part of it that is weighted by (1 - h.o)^5
};

LUXEL_FN float horner6(float x, float c0, float c1, float c2, float c3, float c4, float c5) {
    return c0 + x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * c5))));
}

// One scattering between facets, Smith's correlated masking. Relative error of `whole` at most .003, absolute
// error of `grazing` at most .006, over all cos_o in (0, 1] and alpha in [.0004, 1]; both are exact where
// alpha goes to 0.
LUXEL_FN DirectionalAlbedo ggx_directional_albedo(float cos_o, float alpha) {
    DirectionalAlbedo a;
    float mu = clamp(cos_o, 0.001f, 1.0f);

    // Narrow lobes lose light where cos_o is about alpha: their ratio is the variable to fit in.
    float t = mu / (mu + alpha);
    vec4 y = vec4(1.0f, alpha, alpha * alpha, alpha * alpha * alpha);
    float lost = horner6(t, dot(vec4(-0.020507f, 0.097587f, -0.113793f, 0.047134f), y),
                         dot(vec4(0.766770f, -2.087502f, 5.943452f, -0.947014f), y),
                         dot(vec4(-4.115265f, 15.989148f, -16.201215f, -9.380212f), y),
                         dot(vec4(14.760078f, -50.992519f, 30.711628f, 60.105099f), y),
                         dot(vec4(-19.172501f, 64.273481f, 17.130819f, -159.608404f), y),
                         dot(vec4(7.694260f, -26.599920f, -44.333279f, 134.586611f), y));
    a.whole = clamp(1.0f - lost * (1.0f - t), 0.0f, 1.0f);

    // Its fifth root is 1 - cos_o of a plane, and departs from that with the roughness.
    float r = sqrt(alpha);
    float x = sqrt(mu + alpha);
    vec4 z = vec4(1.0f, r, r * r, r * r * r);
    float departs = horner6(x, dot(vec4(0.019398f, -6.399915f, -30.594427f, 78.303291f), z),
                            dot(vec4(1.587929f, 60.377837f, -3.842227f, -225.782558f), z),
                            dot(vec4(-12.790973f, -136.857124f, 179.713275f, 217.207975f), z),
                            dot(vec4(27.535884f, 114.763875f, -247.789220f, -54.276961f), z),
                            dot(vec4(-19.392544f, -19.922881f, 87.229224f, -9.536729f), z), 0.0f);
    float root = clamp(1.0f - mu + r * departs, 0.0f, 1.0f);
    float root2 = root * root;
    a.grazing = a.whole * root2 * root2 * root;
    return a;
}

LUXEL_END
#endif
