// SPDX-License-Identifier: MIT
// Whether a pixel shows an instance that frame/object_depth.h has drawn. Programs that find displaced surfaces agree to a few
// digits only.
bool shows_object(float object_depth, float hardware_depth) {
    return abs(object_depth - hardware_depth) <= 1e-5 * hardware_depth;
}
