// SPDX-License-Identifier: MIT
// FLIP: two pipelines meet per pixel, color (contrast sensitivity filter, HyAB in Hunt-adjusted L*a*b*) and
// features (edges and points of the lightness); HDR takes the worst over exposures.
// [Andersson2020] "FLIP: A Difference Evaluator for Alternating Images", [Andersson2021] "Visualizing Errors
// in Rendered High Dynamic Range Images".
#include "core/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"

namespace luxel {
namespace {

using Filter = std::vector<float>; // odd length, centered

// The parameters' names in [Andersson2020] follow each.
constexpr float color_exponent = 0.7f;                       // q_c
constexpr float color_knee = 0.4f, color_knee_value = 0.95f; // p_c, p_t
constexpr float feature_exponent = 0.5f;                     // q_f
constexpr double feature_width = 0.082;                      // w, degrees

// Linear sRGB to XYZ as exact fractions of the primaries' chromaticities; the illuminant is white's image.
// Columns are the images of R, G and B.
const glm::mat3 xyz_of_rgb(glm::vec3(10135552.0 / 24577794, 2613072.0 / 12288897, 1425312.0 / 73733382),
                           glm::vec3(8788810.0 / 24577794, 8788810.0 / 12288897, 8788810.0 / 73733382),
                           glm::vec3(4435075.0 / 24577794, 887015.0 / 12288897, 70074185.0 / 73733382));
const glm::mat3 rgb_of_xyz = glm::inverse(xyz_of_rgb);
const glm::vec3 white = xyz_of_rgb * glm::vec3(1.0f);

// The linear opponent space in which the eye's contrast sensitivity is applied [Andersson2020, spatial
// filtering].
glm::vec3 opponent_of_rgb(glm::vec3 rgb) {
    const glm::vec3 q = xyz_of_rgb * rgb / white;
    return {116.0f * q.y - 16.0f, 500.0f * (q.x - q.y), 200.0f * (q.y - q.z)};
}

glm::vec3 rgb_of_opponent(glm::vec3 opponent) {
    const float y = (opponent.x + 16.0f) / 116.0f;
    return rgb_of_xyz * (glm::vec3(y + opponent.y / 500.0f, y, y - opponent.z / 200.0f) * white);
}

// CIE L*a*b*, then the Hunt effect: colors fade in the dark [Andersson2020, perceptually uniform color
// space].
glm::vec3 hunt_lab_of_rgb(glm::vec3 rgb) {
    constexpr float delta = 6.0f / 29.0f;
    const auto root = [](float t) {
        return t > delta * delta * delta ? std::cbrt(t) : t / (3.0f * delta * delta) + 4.0f / 29.0f;
    };
    const glm::vec3 q = xyz_of_rgb * rgb / white;
    const float x = root(q.x), y = root(q.y), z = root(q.z);
    const float lightness = 116.0f * y - 16.0f;
    return {lightness, 0.01f * lightness * 500.0f * (x - y), 0.01f * lightness * 200.0f * (y - z)};
}

// HyAB distance, compressed.
float color_distance(glm::vec3 a, glm::vec3 b) {
    return std::pow(std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z), color_exponent);
}

// out[i] = sum over k of filter[k] * in[k][i], in blocks that the compiler keeps in registers.
void weigh(const std::vector<const float*>& in, const Filter& filter, float* out, std::size_t count) {
    constexpr std::size_t block = 16;
    std::size_t i = 0;
    for (; i + block <= count; i += block) {
        float sum[block] = {};
        for (std::size_t k = 0; k < filter.size(); ++k)
            for (std::size_t j = 0; j < block; ++j) sum[j] += filter[k] * in[k][i + j];
        std::copy(sum, sum + block, out + i);
    }
    for (; i < count; ++i) {
        out[i] = 0.0f;
        for (std::size_t k = 0; k < filter.size(); ++k) out[i] += filter[k] * in[k][i];
    }
}

// Separable convolution of a one-channel image; the border repeats.
Image convolve_rows(const Image& plane, const Filter& filter) {
    Image result(plane.width, plane.height, 1);
    const std::size_t radius = filter.size() / 2, width = std::size_t(plane.width);
    parallel_for(std::size_t(plane.height), 8, [&](std::size_t y) {
        const float* row = plane.at(0, int(y));
        std::vector<float> padded(width + 2 * radius, row[0]);
        std::copy(row, row + width, padded.begin() + std::ptrdiff_t(radius));
        std::fill(padded.end() - std::ptrdiff_t(radius), padded.end(), row[width - 1]);
        std::vector<const float*> in(filter.size());
        for (std::size_t k = 0; k < in.size(); ++k) in[k] = padded.data() + k;
        weigh(in, filter, result.at(0, int(y)), width);
    });
    return result;
}

Image convolve_columns(const Image& plane, const Filter& filter) {
    Image result(plane.width, plane.height, 1);
    const int radius = int(filter.size() / 2);
    parallel_for(std::size_t(plane.height), 8, [&](std::size_t y) {
        std::vector<const float*> in(filter.size());
        for (int k = 0; k < int(in.size()); ++k)
            in[std::size_t(k)] = plane.at(0, std::clamp(int(y) + k - radius, 0, plane.height - 1));
        weigh(in, filter, result.at(0, int(y)), std::size_t(plane.width));
    });
    return result;
}

Image blur(const Image& plane, const Filter& filter) {
    return convolve_columns(convolve_rows(plane, filter), filter);
}

void normalize(Filter& filter) {
    const float sum = std::accumulate(filter.begin(), filter.end(), 0.0f);
    for (float& weight : filter) weight /= sum;
}

// One Gaussian of the contrast sensitivity, exp(-pi^2 x^2 / b) with x in degrees [Andersson2020, spatial
// filtering]. All channels share the radius of three standard deviations of the widest, b = .04.
Filter sensitivity(double b, double pixels_per_degree) {
    constexpr double pi2 = std::numbers::pi * std::numbers::pi;
    const int radius = int(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * pi2)) * pixels_per_degree));
    Filter filter;
    for (int i = -radius; i <= radius; ++i) {
        const double x = i / pixels_per_degree;
        filter.push_back(float(std::exp(-pi2 * x * x / b)));
    }
    return filter;
}

// Blue-yellow is a sum of two Gaussians: filtered apart, weighted by their shares of the sum
// [Andersson2020: a = 34.1, b = .04 and a = 13.5, b = .025].
Image blur_blue_yellow(const Image& plane, double pixels_per_degree) {
    Filter wide = sensitivity(0.04, pixels_per_degree), narrow = sensitivity(0.025, pixels_per_degree);
    const auto weight = [](double a, double b, const Filter& filter) {
        const double sum = std::accumulate(filter.begin(), filter.end(), 0.0);
        return a * std::sqrt(std::numbers::pi / b) * sum * sum;
    };
    const double a = weight(34.1, 0.04, wide), b = weight(13.5, 0.025, narrow);
    normalize(wide), normalize(narrow);
    Image result = blur(plane, wide);
    const Image other = blur(plane, narrow);
    for (std::size_t i = 0; i < result.data.size(); ++i)
        result.data[i] = float((a * result.data[i] + b * other.data[i]) / (a + b));
    return result;
}

// The Gaussian and its two derivatives; positive and negative weights of the derivatives sum to one each.
struct FeatureFilters {
    Filter gauss, first, second;
};

void normalize_signs(Filter& filter) {
    float positive = 0.0f, negative = 0.0f;
    for (const float weight : filter) (weight > 0.0f ? positive : negative) += std::abs(weight);
    for (float& weight : filter) weight /= weight > 0.0f ? positive : negative;
}

FeatureFilters feature_filters(double pixels_per_degree) {
    const double sigma = 0.5 * feature_width * pixels_per_degree;
    const int radius = int(std::ceil(3.0 * sigma));
    FeatureFilters filters;
    for (int x = -radius; x <= radius; ++x) {
        const double gauss = std::exp(-x * x / (2.0 * sigma * sigma));
        filters.gauss.push_back(float(gauss));
        filters.first.push_back(float(-x * gauss));
        filters.second.push_back(float((x * x / (sigma * sigma) - 1.0) * gauss));
    }
    normalize(filters.gauss);
    normalize_signs(filters.first);
    normalize_signs(filters.second);
    return filters;
}

Image magnitude(const Image& x, const Image& y) {
    Image result(x.width, x.height, 1);
    for (std::size_t i = 0; i < result.data.size(); ++i)
        result.data[i] = std::sqrt(x.data[i] * x.data[i] + y.data[i] * y.data[i]);
    return result;
}

// What FLIP compares of one image.
struct Percept {
    Image lab;           // filtered, Hunt-adjusted
    Image edges, points; // magnitudes of first and second derivative of the lightness
};

Percept perceive(const Image& linear, double pixels_per_degree) {
    const int width = linear.width, height = linear.height;
    Image y(width, height, 1), cx(width, height, 1), cz(width, height, 1), lightness(width, height, 1);
    parallel_for(linear.pixels(), 4096, [&](std::size_t i) {
        const float* p = &linear.data[3 * i];
        const glm::vec3 opponent = opponent_of_rgb({p[0], p[1], p[2]});
        y.data[i] = opponent.x, cx.data[i] = opponent.y, cz.data[i] = opponent.z;
        lightness.data[i] = (opponent.x + 16.0f) / 116.0f;
    });

    // Color: what the eye resolves, back in the displayable range.
    Filter achromatic = sensitivity(0.0047, pixels_per_degree),
           red_green = sensitivity(0.0053, pixels_per_degree);
    normalize(achromatic), normalize(red_green);
    y = blur(y, achromatic), cx = blur(cx, red_green), cz = blur_blue_yellow(cz, pixels_per_degree);
    Percept percept{Image(width, height, 3), {}, {}};
    parallel_for(linear.pixels(), 4096, [&](std::size_t i) {
        const glm::vec3 rgb = glm::clamp(rgb_of_opponent({y.data[i], cx.data[i], cz.data[i]}), 0.0f, 1.0f);
        const glm::vec3 lab = hunt_lab_of_rgb(rgb);
        std::copy(&lab.x, &lab.x + 3, &percept.lab.data[3 * i]);
    });

    // Features: derivatives of Gaussians along x and y [Andersson2020, feature pipeline].
    const FeatureFilters filters = feature_filters(pixels_per_degree);
    const Image smooth = convolve_rows(lightness, filters.gauss);
    percept.edges = magnitude(convolve_columns(convolve_rows(lightness, filters.first), filters.gauss),
                              convolve_columns(smooth, filters.first));
    percept.points = magnitude(convolve_columns(convolve_rows(lightness, filters.second), filters.gauss),
                               convolve_columns(smooth, filters.second));
    return percept;
}

// Linear RGB in [0, 1]; one channel of errors in [0, 1].
Image error_map(const Image& reference, const Image& test, double pixels_per_degree) {
    const Percept a = perceive(reference, pixels_per_degree), b = perceive(test, pixels_per_degree);
    const float largest = color_distance(hunt_lab_of_rgb({0, 1, 0}), hunt_lab_of_rgb({0, 0, 1}));
    const float knee = color_knee * largest;
    Image map(reference.width, reference.height, 1);
    parallel_for(map.pixels(), 4096, [&](std::size_t i) {
        // Color error, spread so that [0, knee] takes most of the range [Andersson2020, error
        // redistribution].
        const float* p = &a.lab.data[3 * i];
        const float* q = &b.lab.data[3 * i];
        const float distance = color_distance({p[0], p[1], p[2]}, {q[0], q[1], q[2]});
        const float color = distance < knee ? distance * color_knee_value / knee
                                            : color_knee_value + (distance - knee) / (largest - knee) *
                                                                     (1.0f - color_knee_value);

        // A differing edge or point makes the color error more visible [Andersson2020, final difference].
        const float edge = std::abs(a.edges.data[i] - b.edges.data[i]);
        const float point = std::abs(a.points.data[i] - b.points.data[i]);
        const float feature =
            std::pow(std::max(edge, point) / std::numbers::sqrt2_v<float>, feature_exponent);
        map.data[i] = std::pow(color, 1.0f - feature);
    });
    return map;
}

FlipResult pooled(Image map, const Image& mask) {
    FlipResult result;
    std::vector<float> sorted = inside(map, mask);
    if (!mask.empty())
        for (std::size_t i = 0; i < map.data.size(); ++i)
            if (!(mask.data[i] > 0.0f)) map.data[i] = 0.0f;
    if (sorted.empty()) sorted.push_back(0.0f); // nothing counts
    std::sort(sorted.begin(), sorted.end());
    const double sum = std::accumulate(sorted.begin(), sorted.end(), 0.0);
    result.mean = sum / double(sorted.size());
    result.max = sorted.back();

    // The error below which half of the total error lies [Andersson2020, weighted histogram].
    double running = 0.0;
    for (const float error : sorted) {
        running += error;
        result.weighted_median = error;
        if (running > 0.5 * sum) break;
    }
    result.map = std::move(map);
    return result;
}

// NaN and negative values count as black; the cap keeps the tone curve's squares finite.
float finite(float value) { return value > 0.0f ? std::min(value, 1e12f) : 0.0f; }

// ACES as fitted by Narkowicz, without its exposure bias of .6 [Andersson2021]:
// (a x^2 + b x) / (c x^2 + d x + e).
constexpr float aces_a = 0.36f * 2.51f, aces_b = 0.6f * 0.03f, aces_c = 0.36f * 2.43f, aces_d = 0.6f * 0.59f,
                aces_e = 0.14f;

float tone_map(float x) {
    return std::clamp(x * (aces_a * x + aces_b) / (x * (aces_c * x + aces_d) + aces_e), 0.0f, 1.0f);
}

template <class Map> Image mapped(const Image& image, Map&& map) {
    Image result(image.width, image.height, 3);
    parallel_for(std::size_t(image.height), 16, [&](std::size_t y) {
        for (int x = 0; x < image.width; ++x) {
            const glm::vec3 c = image.rgb(x, int(y));
            result.set_rgb(x, int(y), {map(c.r), map(c.g), map(c.b)});
        }
    });
    return result;
}

void check_pair(const Image& reference, const Image& test, const Image& mask) {
    LUXEL_ASSERT(reference.width == test.width && reference.height == test.height && !reference.empty(),
                 "{}x{} against {}x{}", reference.width, reference.height, test.width, test.height);
    LUXEL_ASSERT(mask.empty() || mask.data.size() == reference.pixels(), "mask {}x{}x{}, image {}x{}",
                 mask.width, mask.height, mask.channels, reference.width, reference.height);
}

// `image` where the mask counts, `outside` where it does not.
Image joined(const Image& image, const Image& outside, const Image& mask) {
    Image result(image.width, image.height, 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            result.set_rgb(x, y, (mask.empty() || *mask.at(x, y) > 0.0f ? image : outside).rgb(x, y));
    return result;
}

} // namespace

std::vector<float> inside(const Image& map, const Image& mask) {
    if (mask.empty()) return map.data;
    std::vector<float> values;
    for (std::size_t i = 0; i < map.data.size(); ++i)
        if (mask.data[i] > 0.0f) values.push_back(map.data[i]);
    return values;
}

FlipResult flip_ldr(const Image& reference, const Image& test, const Image& mask, double pixels_per_degree) {
    check_pair(reference, test, mask);
    const auto decode = [](float value) { return srgb_decode(std::min(finite(value), 1.0f)); };
    const Image map = error_map(mapped(reference, decode), mapped(joined(test, reference, mask), decode),
                                pixels_per_degree);
    return pooled(map, mask);
}

HdrExposures flip_exposures(const Image& reference, const Image& mask) {
    std::vector<float> values;
    for (int y = 0; y < reference.height; ++y)
        for (int x = 0; x < reference.width; ++x)
            if (mask.empty() || *mask.at(x, y) > 0.0f)
                values.push_back(finite(luminance(reference.rgb(x, y))));
    const float brightest = values.empty() ? 0.0f : *std::max_element(values.begin(), values.end());
    if (brightest == 0.0f) return {0.0, 0.0, 2};

    // A picture that is mostly background has no median to expose: the lit part's is meant.
    const auto median = [&values] {
        const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    };
    float typical = median();
    if (typical == 0.0f) {
        std::erase(values, 0.0f);
        typical = median();
    }

    // The tone curve reaches .85 at x: the brightest pixel is brought there first, the median last
    // [Andersson2021, automatic exposures].
    constexpr double target = 0.85;
    const double a = aces_a - target * aces_c, b = aces_b - target * aces_d, c = -target * aces_e;
    const double x = -0.5 * b / a + std::sqrt(0.25 * b * b / (a * a) - c / a);
    const double start = std::log2(x / brightest), stop = std::log2(x / typical);
    return {start, stop, std::max(2, int(std::ceil(stop - start)))};
}

FlipResult flip_hdr(const Image& reference, const Image& test, const Image& mask, double pixels_per_degree) {
    check_pair(reference, test, mask);
    const HdrExposures exposures = flip_exposures(reference, mask);
    const Image compared = joined(test, reference, mask);
    Image worst(reference.width, reference.height, 1);
    for (int i = 0; i < exposures.count; ++i) {
        const double stops = exposures.start + (exposures.stop - exposures.start) * i / (exposures.count - 1);
        const auto expose = [scale = float(std::exp2(stops))](float value) {
            return tone_map(finite(value) * scale);
        };
        const Image map = error_map(mapped(reference, expose), mapped(compared, expose), pixels_per_degree);
        std::transform(map.data.begin(), map.data.end(), worst.data.begin(), worst.data.begin(),
                       [](float a, float b) { return std::max(a, b); });
    }
    return pooled(std::move(worst), mask);
}

} // namespace luxel
