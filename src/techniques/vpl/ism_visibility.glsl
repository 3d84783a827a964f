// SPDX-License-Identifier: MIT
// Visibility by imperfect shadow maps. The including file has read vpl_params.h.

// Whether nothing is nearer to map i's origin than a surface point, which moves along its normal so far that its own
// plane cannot shadow it: by half a texel's diagonal times the share of the plane's slope, as in docs/frame.md,
// and as far again for the points, which lie anywhere in their texels. axis: of the map's hemisphere.
float ism_visibility(sampler2D maps, IsmParams ism, int i, vec3 origin, vec3 axis, vec3 position, vec3 plane) {
    mat3 around = frame_around(axis);
    vec3 v = position - origin, w = normalize(v);
    float c = dot(plane, w), slope = sqrt(max(1.0 - c * c, 0.0));
    float texel = length(v) * ism_texel(to_paraboloid(w * around), ism.size);
    v = (v + plane * (1.4142136 * texel * slope)) * around;
    float d = length(v);
    vec2 m = to_paraboloid(v / d) * 0.5 + 0.5;
    ivec2 at = clamp(ivec2(m * float(ism.size)), ivec2(0), ivec2(ism.size - 1));
    return d * texelFetch(maps, ism_corner(i, ism) + at, 0).r <= 1.0 ? 1.0 : 0.0;
}
