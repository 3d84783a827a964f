// SPDX-License-Identifier: MIT
// What a coarser texel knows of its four parts: the farthest, where two of them have a value at least (one alone
// may stand beside open sky). [Ritschel2008] takes means; on slanted surfaces they shadow the corners of a room.
float farthest_of_valid(vec4 values) {
    vec4 far = mix(vec4(1e30), values, greaterThan(values, vec4(0))); // 1/distance
    float count = dot(vec4(greaterThan(values, vec4(0))), vec4(1));
    return count >= 2.0 ? min(min(far.x, far.y), min(far.z, far.w)) : 0.0;
}
