// SPDX-License-Identifier: MIT
// Joint bilateral upsampling [Rohleder2010, eq. 27 and 28]: bilinear weights times 1/(eps + |dz|), here with the depth
// difference relative to the pixel's own depth and the agreement of normals besides.

// coarse_guide: normal in rgb, linear depth in a (0 = nothing). pixel: full-size coordinate (centers at .5).
// Zero where no coarse neighbor holds a surface.
vec4 bilateral_upsample(sampler2D coarse, sampler2D coarse_guide, vec2 pixel, float scale, vec3 normal, float depth) {
    vec2 at = pixel / scale - 0.5;
    ivec2 base = ivec2(floor(at));
    vec2 f = at - vec2(base);
    ivec2 last = textureSize(coarse, 0) - 1;
    vec4 sum = vec4(0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 o = ivec2(i & 1, i >> 1);
        ivec2 q = clamp(base + o, ivec2(0), last);
        vec4 guide = texelFetch(coarse_guide, q, 0);
        if (guide.w <= 0.0) continue;
        float bilinear = (o.x == 1 ? f.x : 1.0 - f.x) * (o.y == 1 ? f.y : 1.0 - f.y);
        float c = max(dot(guide.xyz, normal), 0.0);
        float w = (bilinear + 1e-4) * (c * c + 1e-3) / (0.005 + abs(guide.w - depth) / depth);
        sum += w * texelFetch(coarse, q, 0);
        weights += w;
    }
    return weights > 0.0 ? sum / weights : vec4(0);
}
