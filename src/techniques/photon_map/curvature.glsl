// SPDX-License-Identifier: MIT
// How the shading normal changes along a surface, from the lists.

// Where the center of a pixel shows a facet.
vec3 center_of_facet(ivec2 pixel, vec3 n, float offset) {
    mat4 rows = transpose(p.view.to_pixel);
    vec4 x = rows[0] - (float(pixel.x) + 0.5) * rows[3], y = rows[1] - (float(pixel.y) + 0.5) * rows[3];
    vec3 yn = cross(y.xyz, n);
    return (-x.w * yn - y.w * cross(n, x.xyz) + offset * cross(x.xyz, y.xyz)) / dot(x.xyz, yn);
}

struct Found {
    vec3 place, n;
    float apart; // from the facet's plane, m
};

// The surface of the instance that is nearest to a point, in the list of the point's pixel.
Found surface_near(vec3 point, uvec4 like) {
    Found found = Found(vec3(0), vec3(0), 1e30);
    vec4 at = p.view.to_pixel * vec4(point, 1.0);
    ivec2 pixel = ivec2(floor(at.xy / at.w));
    if (at.w <= 0.0 || any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, ivec2(p.view.side)))) return found;
    vec3 plane = unpack_unit(like[LIST_NORMAL]);
    for (uint i = head_of[pixel.y * p.view.side + pixel.x]; i != LIST_END;) {
        uvec4 node = node_of[i];
        vec3 n = unpack_unit(node[LIST_NORMAL]);
        float offset = uintBitsToFloat(node[LIST_OFFSET]), apart = abs(dot(n, point) - offset);
        if (node[LIST_WHAT] == like[LIST_WHAT] && dot(n, plane) > 0.5 && apart < found.apart)
            found = Found(center_of_facet(pixel, n, offset), unpack_unit(shading_of[i]), apart);
        i = node[LIST_NEXT];
    }
    return found;
}

struct Change {
    vec3 n;
    bool there;
};

// Over a step on the surface, from pixels at both sides of it.
Change normal_change(vec3 point, vec3 step, uvec4 like) {
    const float pixels = 2.0;
    float size = length(step), reach = pixels * p.view.pixel * (p.view.to_pixel * vec4(point, 1.0)).w;
    vec3 along = step / max(size, 1e-20);
    Found ahead = surface_near(point + along * reach, like), behind = surface_near(point - along * reach, like);
    float apart = dot(ahead.place - behind.place, along);
    bool there = size > 0.0 && max(ahead.apart, behind.apart) < reach && apart > reach;
    return Change(there ? (ahead.n - behind.n) * (size / apart) : vec3(0), there);
}

// Lists have normals at the pixels' centers: between them they follow the curvature.
vec3 normal_at(vec3 point, uvec4 like, vec3 otherwise) {
    Found here = surface_near(point, like);
    if (here.apart >= 1e30) return otherwise;
    return normalize(here.n + normal_change(point, point - here.place, like).n);
}
