// SPDX-License-Identifier: MIT
// Radiance of the environment. The including file has read techniques/frame/compose_params.h.

vec3 sky_radiance(sampler2D environment, vec3 direction, float rotation, float scale) {
    if (scale <= 0.0) return vec3(0);
    ivec2 size = textureSize(environment, 0);
    ivec2 texel = ivec2(environment_uv(direction, rotation) * vec2(size));
    return texelFetch(environment, clamp(texel, ivec2(0), size - 1), 0).rgb * scale;
}
