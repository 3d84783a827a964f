// SPDX-License-Identifier: MIT
#include "reference/stopping.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "reference/reference.h"

namespace luxel {
namespace {

// A standard deviation that is taken from four values is too small by this factor on average, and itself has
// a relative standard deviation of sqrt(1 - c4^2) / c4.
constexpr double c4 = 0.921318;
const double scatter_of_deviation = std::sqrt(1.0 - c4 * c4) / c4;

std::vector<std::string> names_of(const Estimate& estimate, const std::vector<std::string>& components) {
    if (!components.empty()) return components;
    if (estimate.mean.contains("full")) return {"full"};
    return estimate.mean.empty() ? std::vector<std::string>{} : std::vector{estimate.mean.begin()->first};
}

double luminance_of(const Layers& layers, const std::vector<std::string>& names, int x, int y) {
    double sum = 0.0;
    for (const std::string& name : names) sum += double(luminance(layers.at(name).rgb(x, y)));
    return sum;
}

} // namespace

// The samples of a group cover each integral evenly, so that a mean errs much less than as many independent
// samples would; the groups are independent of each other, so that their scatter knows.
std::optional<RelativeError> relative_error(const Estimate& estimate,
                                            const std::vector<std::string>& components) {
    const std::vector<std::string> names = names_of(estimate, components);
    if (names.empty() || estimate.spp < samples_for_error) return std::nullopt;
    double sum = 0.0, squares = 0.0;
    std::size_t count = 0;
    for (int y = 0; y < estimate.height; ++y)
        for (int x = 0; x < estimate.width; ++x) {
            const double level = luminance_of(estimate.mean, names, x, y);
            if (!(level > 0.0)) continue;
            double scatter = 0.0; // of a single sample, as far as groups tell
            for (int g = 0; g < sample_groups; ++g) {
                const double d = luminance_of(estimate.group[std::size_t(g)], names, x, y) - level;
                scatter += group_samples(estimate.spp, g) * d * d / (sample_groups - 1);
            }
            const double error = std::sqrt(scatter / estimate.spp) / (c4 * level);
            sum += error, squares += error * error;
            ++count;
        }
    if (count == 0) return RelativeError{};
    return RelativeError{sum / double(count), scatter_of_deviation * std::sqrt(squares) / double(count)};
}

int next_look(int spp) {
    int look = samples_for_error;
    while (look <= spp) look += std::max(sample_groups, look / 16 / sample_groups * sample_groups);
    return look;
}

bool is_look(int spp) { return spp > 0 && next_look(spp - 1) == spp; }

} // namespace luxel
