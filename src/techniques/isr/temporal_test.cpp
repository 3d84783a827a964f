// SPDX-License-Identifier: MIT
// Accumulation over frames: less variance, no trace of what is no longer there beyond the stated bound.
#include "techniques/isr/test_frame.h"

namespace luxel {
namespace {

using testing::Analytic;
using testing::floor_and_wall;
using testing::IsrTestFrame;
using testing::view_from;

constexpr int size = 64;

Isr make(const std::string& frames, const std::string& samples = "8") {
    Isr isr;
    set_parameters(isr, "isr",
                   {{"samples", samples}, {"blur", "0"}, {"resolution", "full"}, {"temporal", frames}});
    return isr;
}

Image last_of(IsrTestFrame& f, Isr& isr, int frames) {
    Image image;
    for (int i = 0; i < frames; ++i) image = f.run(isr).first;
    return image;
}

// Mean square difference, and the mean itself relative to the truth's.
struct Difference {
    double square = 0, mean = 0;
};
Difference compare(const Image& image, const Image& truth) {
    Difference d;
    double sum = 0, sum_truth = 0;
    for (std::size_t i = 0; i < image.data.size(); ++i) {
        d.square += std::pow(double(image.data[i]) - double(truth.data[i]), 2) / double(image.data.size());
        sum += double(image.data[i]), sum_truth += double(truth.data[i]);
    }
    d.mean = sum / sum_truth;
    return d;
}

TEST(IsrTemporal, VarianceFallsWithTheFrames) {
    IsrTestFrame f(size, size, floor_and_wall);
    Isr long_run = make("256"), sixteen = make("16"), single = make("1");
    Image truth = last_of(f, long_run, 256);
    double one = compare(f.run(single).first, truth).square;
    double mean = compare(last_of(f, sixteen, 16), truth).square;
    EXPECT_LT(mean, one / 12); // 1/16 for independent frames
    EXPECT_GT(one, 1e-6);
}

TEST(IsrTemporal, MovingCameraKeepsTheGainWithoutBias) {
    IsrTestFrame f(size, size, floor_and_wall);
    Isr moving = make("16"), single = make("1"), long_run = make("256");
    Image image;
    for (int i = 0; i <= 20; ++i) {
        f.see(view_from(0.02f * float(i), size, size));
        image = f.run(moving).first;
    }
    Image truth = last_of(f, long_run, 256);
    Difference still = compare(f.run(single).first, truth), moved = compare(image, truth);
    EXPECT_LT(moved.square, still.square / 4);
    EXPECT_NEAR(moved.mean, 1.0, 0.02);
}

TEST(IsrTemporal, LightThatIsGoneFadesByTheFramesOfTheMean) {
    // The bound: after k frames (1 - 1/n)^k of what was there.
    float radiance = 1;
    IsrTestFrame f(size, size, [&](glm::vec3 o, glm::vec3 ray) {
        Analytic a = floor_and_wall(o, ray);
        a.radiance *= radiance;
        return a;
    });
    Isr isr = make("8");
    Image before = last_of(f, isr, 16);
    radiance = 0;
    f.see(f.frame.view);
    for (int k = 1; k <= 12; ++k) {
        Image now = f.run(isr).first;
        float share = std::pow(1.0f - 1.0f / 8.0f, float(k));
        for (std::size_t i = 0; i < now.data.size(); ++i)
            ASSERT_NEAR(now.data[i], share * before.data[i], 1e-4f);
    }
}

TEST(IsrTemporal, OtherSurfacesTakeNothingOver) {
    // The floor sinks by a fifth of its distance while the light goes out: nothing of the old floor is on it.
    float radiance = 1, sunk = 0;
    IsrTestFrame f(size, size, [&](glm::vec3 o, glm::vec3 ray) {
        Analytic a = floor_and_wall(o + glm::vec3(0, sunk, 0), ray);
        a.radiance *= radiance;
        return a;
    });
    Isr isr = make("16");
    Image before = last_of(f, isr, 16);
    EXPECT_GT(*std::max_element(before.data.begin(), before.data.end()), 0.1f);
    radiance = 0, sunk = 0.2f;
    f.see(f.frame.view);
    Image now = f.run(isr).first;
    EXPECT_EQ(*std::max_element(now.data.begin(), now.data.end()), 0.0f);
}

TEST(IsrTemporal, AnotherSizeOrRendererBeginsAnew) {
    IsrTestFrame f(size, size, floor_and_wall);
    Isr isr = make("16"), fresh = make("16");
    Image first = f.run(fresh).first;
    last_of(f, isr, 8);
    isr.prepare(f.gpu, Scene{});
    EXPECT_EQ(f.run(isr).first.data, first.data);

    last_of(f, isr, 8);
    f.see(view_from(0, 48, 32));
    Image smaller = f.run(isr).first;
    Isr plain = make("1", "512");
    EXPECT_NEAR(compare(smaller, f.run(plain).first).mean, 1.0, 0.1);
}

} // namespace
} // namespace luxel
