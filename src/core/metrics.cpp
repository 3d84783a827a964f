// SPDX-License-Identifier: MIT
// Distances between images; sums in double and in a fixed order, so figures do not depend on the thread
// count.
#include "core/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"

namespace luxel {
namespace {

void check_sizes(const Image& a, const Image& b, const Image& mask) {
    LUXEL_ASSERT(a.width == b.width && a.height == b.height && !a.empty(), "{}x{} against {}x{}", a.width,
                 a.height, b.width, b.height);
    LUXEL_ASSERT(mask.empty() || (mask.width == a.width && mask.height == a.height),
                 "mask {}x{}, image {}x{}", mask.width, mask.height, a.width, a.height);
}

bool counts(const Image& mask, int x, int y) { return mask.empty() || *mask.at(x, y) > 0.0f; }

// Mean of value(x, y) over the pixels that count; 0 when none does.
template <class Value> double mean(const Image& image, const Image& mask, Value&& value) {
    double sum = 0.0;
    std::size_t count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (counts(mask, x, y)) sum += value(x, y), ++count;
    return count ? sum / double(count) : 0.0;
}

double average(glm::dvec3 v) { return (v.x + v.y + v.z) / 3.0; }

double squared_error(const Image& reference, const Image& image, const Image& mask) {
    check_sizes(reference, image, mask);
    return mean(reference, mask, [&](int x, int y) {
        const glm::dvec3 d = glm::dvec3(image.rgb(x, y)) - glm::dvec3(reference.rgb(x, y));
        return average(d * d);
    });
}

// Mean absolute difference of the channels of one pixel.
double distance(const Image& a, const Image& b, int x, int y) {
    return average(glm::abs(glm::dvec3(a.rgb(x, y)) - glm::dvec3(b.rgb(x, y))));
}

// The thesis's own luminance weights [Rohleder2010, eq. 17].
double thesis_luminance(glm::dvec3 c) { return 0.27 * c.r + 0.67 * c.g + 0.06 * c.b; }

// SSIM's 11 x 11 Gaussian of sigma 1.5, separable.
constexpr int window_radius = 5;
using Window = std::array<double, 2 * window_radius + 1>;

Window gaussian_window() {
    Window window;
    double total = 0.0;
    for (int i = -window_radius; i <= window_radius; ++i)
        total += window[std::size_t(i + window_radius)] = std::exp(-i * i / (2.0 * 1.5 * 1.5));
    for (double& weight : window) weight /= total;
    return window;
}

// Weighted sums of 1, a, b, a^2, b^2 and ab over the pixels that count; a and b are the luminances of two
// images.
using Moments = std::array<double, 6>;

// Along rows, for every whole window of a row.
std::vector<Moments> row_moments(const Image& reference, const Image& image, const Image& mask,
                                 const Window& window) {
    const int inner_width = reference.width - 2 * window_radius;
    std::vector<Moments> rows(std::size_t(inner_width) * std::size_t(reference.height));
    parallel_for(std::size_t(reference.height), 8, [&](std::size_t y) {
        for (int x = 0; x < inner_width; ++x) {
            Moments& sum = rows[y * std::size_t(inner_width) + std::size_t(x)];
            for (std::size_t k = 0; k < window.size(); ++k) {
                if (!counts(mask, x + int(k), int(y))) continue;
                const double a = luminance(reference.rgb(x + int(k), int(y)));
                const double b = luminance(image.rgb(x + int(k), int(y)));
                const Moments moments = {1.0, a, b, a * a, b * b, a * b};
                for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += window[k] * moments[m];
            }
        }
    });
    return rows;
}

double similarity_of(const Moments& moments) {
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03; // (K L)^2 with L = 1
    const auto [weight, sum_a, sum_b, sum_aa, sum_bb, sum_ab] = moments;
    const double a = sum_a / weight, b = sum_b / weight;
    const double aa = sum_aa / weight, bb = sum_bb / weight, ab = sum_ab / weight;
    const double covariance = ab - a * b, variances = aa - a * a + bb - b * b;
    return (2.0 * a * b + c1) * (2.0 * covariance + c2) / ((a * a + b * b + c1) * (variances + c2));
}

} // namespace

double rmse(const Image& reference, const Image& image, const Image& mask) {
    return std::sqrt(squared_error(reference, image, mask));
}

double relmse(const Image& reference, const Image& image, const Image& mask) {
    check_sizes(reference, image, mask);
    return mean(reference, mask, [&](int x, int y) {
        const glm::dvec3 r(reference.rgb(x, y)), d = glm::dvec3(image.rgb(x, y)) - r;
        return average(d * d / (r * r + 0.01));
    });
}

double mean_error(const Image& reference, const Image& image, const Image& mask) {
    check_sizes(reference, image, mask);
    return mean(reference, mask, [&](int x, int y) { return distance(reference, image, x, y); });
}

double correlation(const Image& reference, const Image& image, const Image& mask) {
    check_sizes(reference, image, mask);
    const auto a = [&](int x, int y) { return thesis_luminance(reference.rgb(x, y)); };
    const auto b = [&](int x, int y) { return thesis_luminance(image.rgb(x, y)); };
    const double mean_a = mean(reference, mask, a), mean_b = mean(reference, mask, b);
    const auto moment = [&](auto&& f, double mean_f, auto&& g, double mean_g) {
        return mean(reference, mask, [&](int x, int y) { return (f(x, y) - mean_f) * (g(x, y) - mean_g); });
    };
    const double covariance = moment(a, mean_a, b, mean_b);
    const double variances = moment(a, mean_a, a, mean_a) * moment(b, mean_b, b, mean_b);

    // Without variance there is no correlation to speak of, unless both are flat alike.
    if (variances <= 0.0) return mean_a == mean_b ? 1.0 : 0.0;
    return std::clamp(covariance / std::sqrt(variances), -1.0, 1.0);
}

double psnr(const Image& reference, const Image& image, const Image& mask) {
    const double error = squared_error(reference, image, mask);
    return error > 0.0 ? -10.0 * std::log10(error) : std::numeric_limits<double>::infinity();
}

double ssim(const Image& reference, const Image& image, const Image& mask) {
    check_sizes(reference, image, mask);
    const int width = reference.width, height = reference.height;
    const int inner_width = width - 2 * window_radius, inner_height = height - 2 * window_radius;
    if (inner_width < 1 || inner_height < 1) return std::numeric_limits<double>::quiet_NaN();
    const Window window = gaussian_window();
    const std::vector<Moments> rows = row_moments(reference, image, mask, window);

    // [Wang2004, eq. 13] at every whole window whose center counts, over the pixels in it that count.
    Image similarity(width, height, 1), inside(width, height, 1);
    parallel_for(std::size_t(inner_height), 8, [&](std::size_t y) {
        for (int x = 0; x < inner_width; ++x) {
            Moments sum{};
            for (std::size_t k = 0; k < window.size(); ++k)
                for (std::size_t m = 0; m < sum.size(); ++m)
                    sum[m] += window[k] * rows[(y + k) * std::size_t(inner_width) + std::size_t(x)][m];
            const int center_x = x + window_radius, center_y = int(y) + window_radius;
            if (!counts(mask, center_x, center_y)) continue;
            *similarity.at(center_x, center_y) = float(similarity_of(sum));
            *inside.at(center_x, center_y) = 1.0f;
        }
    });
    return mean(similarity, inside, [&](int x, int y) { return double(*similarity.at(x, y)); });
}

int quality(double delta_a, double delta_b) { return delta_a < delta_b ? 1 : delta_b < delta_a ? -1 : 0; }

double gain(double delta_baseline, double delta) {
    return delta_baseline > 0.0 ? 100.0 * (delta_baseline - delta) / delta_baseline : 0.0;
}

Improvement improvement(const Image& reference, const Image& baseline, const Image& image,
                        const Image& mask) {
    check_sizes(reference, image, mask);
    check_sizes(reference, baseline, mask);
    const auto share = [&](int sign) {
        return mean(reference, mask, [&](int x, int y) {
            const double ours = distance(reference, image, x, y),
                         before = distance(reference, baseline, x, y);
            return quality(ours, before) == sign ? 1.0 : 0.0;
        });
    };
    return {share(1), share(0)};
}

Image difference_picture(const Image& a, const Image& b) {
    check_sizes(a, b, {});
    Image picture(a.width, a.height, 3);
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) picture.set_rgb(x, y, 1.0f - glm::abs(a.rgb(x, y) - b.rgb(x, y)));
    return picture;
}

} // namespace luxel
