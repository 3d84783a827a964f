// SPDX-License-Identifier: MIT
// The horizon search: points of the depth buffer along a slice.
#include "techniques/common/occlusion.glsl"
#include "techniques/common/horizon.h"

// The point of the depth buffer so many meters along a line through the receiver, but at least the next pixel;
// distance2 > 1 where there is none. `line`: pixels per meter.
HorizonPoint horizon_point(OcclusionParams o, Receiver x, ivec2 pixel, HorizonSlice s, vec2 line, float meters) {
    HorizonPoint p = HorizonPoint(-1.0, -1.0, 2.0);
    float least = 1.0 / max(max(abs(line.x), abs(line.y)), 1e-20);
    ivec2 q = ivec2(round(vec2(pixel) + line * max(meters, least)));
    if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, o.size))) return p;
    float z = texelFetch(depth, q, 0).r;
    vec3 at = occlusion_ray(o, q) * z, v = at - x.position;

    // Nothing at or below the tangent plane hides what is above it; 1/100 covers the rounding of normals, which are
    // half floats.
    float d2 = dot(v, v);
    if (z <= 0.0 || dot(v, x.normal) <= 0.01 * sqrt(d2) + 1e-5 * z) return p;
    vec3 back = v + at * (o.thickness * inversesqrt(dot(at, at)));
    vec2 a = vec2(dot(v, s.view), dot(v, s.tangent)), b = vec2(dot(back, s.view), dot(back, s.tangent));
    p.high = a.x * inversesqrt(dot(a, a));
    p.low = b.x * inversesqrt(dot(b, b));
    p.distance2 = d2 / (o.radius * o.radius);
    return p;
}
