// SPDX-License-Identifier: MIT
// At every pixel.
#include "techniques/vpl/gather.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(p.view.width) || pixel.y >= int(p.view.height)) return;
    float z = texelFetch(depth, pixel, 0).r;
    vec4 result = vec4(0);
    if (z > 0.0) {
        Receiver r = Receiver(world_position(p.view, vec2(pixel) + 0.5, z),
                              normalize(texelFetch(normal, pixel, 0).xyz),
                              normalize(texelFetch(geometric_normal, pixel, 0).xyz));
        result = vec4(gathered(r), 1);
    }
    imageStore(irradiance, pixel, result);
}
