// SPDX-License-Identifier: MIT
// Prelude of every header that both compilers read (C++20 with GLM, and GLSL 4.60 with scalar layout).
// Rules for such code: functions marked LUXEL_FN, no swizzles of more than one component, no `out`
// parameters (return a struct), literals with an f suffix, no implicit conversions, no recursion.
#ifndef LUXEL_SHARED_GLSL_H
#define LUXEL_SHARED_GLSL_H

#ifdef __cplusplus
#include <cstdint>

#include <glm/glm.hpp>

#define LUXEL_FN inline
#define LUXEL_CONST inline constexpr
#define LUXEL_BEGIN namespace luxel::shared {
#define LUXEL_END }
namespace luxel::shared {
using namespace glm;
using uint = std::uint32_t;
} // namespace luxel::shared
#else
#define LUXEL_FN
#define LUXEL_CONST const
#define LUXEL_BEGIN
#define LUXEL_END
#endif

LUXEL_BEGIN
LUXEL_CONST float PI = 3.14159265358979323846f;
LUXEL_END

#endif
