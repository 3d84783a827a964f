// SPDX-License-Identifier: MIT
// Poisson-disk point sets for tap tables, made here and the same on every run: candidates of low discrepancy,
// thinned by sample elimination [Yuksel2015].
#pragma once
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace luxel {

// n of `candidates` (at least n, spread over a domain of `dimensions` 2 or 3 and area or volume `measure`)
// that keep far from each other.
std::vector<glm::vec3> eliminate_samples(std::vector<glm::vec3> candidates, int n, int dimensions,
                                         float measure);

// Unit disc, z = 0. Elimination crowds the rim of a domain that does not wrap around; radii are therefore
// moved, in their order, to those of a uniform density: sqrt((i + 1/2) / n).
std::vector<glm::vec3> poisson_disc(int n);

// Unit disc times [0, 1], uniform density, in z as well as in the radius: a direction (lifted to the
// hemisphere it has density cos/pi) and a number that a distance is made of.
std::vector<glm::vec3> poisson_cylinder(int n);

// Unit ball, uniform density.
std::vector<glm::vec3> poisson_ball(int n);

} // namespace luxel
