// SPDX-License-Identifier: MIT
// What a caustic cube map sends to a point [Umenhoffer2009, 6.1.3]. The including file declares the maps
// `distance_map` and `caustic`.

// Irradiance at x, relative to the center, on a surface with normal n: 0 where x is not what the center sees. texel: of the
// distance map, radians.
vec3 caustic_irradiance(vec3 x, vec3 n, float texel) {
    float distance = length(x), facing = abs(dot(n, x)) / distance;

    // On one surface the distance changes by this much over two texels.
    float tolerance = 0.01 + 2.0 * texel / max(facing, 0.05);
    if (abs(distance / textureLod(distance_map, x, 0.0).r - 1.0) > tolerance) return vec3(0);
    return textureLod(caustic, x, 0.0).rgb;
}
