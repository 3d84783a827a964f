// SPDX-License-Identifier: MIT
// What a comparison of two files says, and what it does not pass over.
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/file.h"
#include "core/image_io.h"
#include "experiments/image_difference.h"

namespace luxel {
namespace {

class ImageDifference : public ::testing::Test {
protected:
    ImageDifference()
        : folder_(std::filesystem::path(::testing::TempDir()) /
                  ("image_difference_" +
                   std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()))) {
        std::filesystem::create_directories(folder_);
    }
    ~ImageDifference() override { std::filesystem::remove_all(folder_); }
    std::filesystem::path file(const std::string& name) const { return folder_ / name; }
    std::filesystem::path exr(const std::string& name, const Layers& layers,
                              const Attributes& attributes = {}) const {
        write_exr(file(name), layers, attributes);
        return file(name);
    }
    static bool says(const Difference& d, const std::string& what) {
        for (const std::string& warning : d.warnings)
            if (warning.find(what) != std::string::npos) return true;
        return false;
    }

private:
    std::filesystem::path folder_;
};

Image ramp(glm::vec3 color) {
    Image image(64, 48, 3);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) image.set_rgb(x, y, color * (float(x) + 0.5f) / 64.0f);
    return image;
}

TEST_F(ImageDifference, IsTheSameForEveryColor) {
    const auto delta = [&](glm::vec3 color) {
        return difference(exr("a.exr", {{"", ramp(color)}}), exr("b.exr", {{"", ramp(1.1f * color)}}), {}, "")
            .figures.delta;
    };
    const double red = delta({1, 0, 0});
    EXPECT_GT(red, 0.005);
    EXPECT_NEAR(red, delta({0, 1, 0}), 1e-9);
    EXPECT_NEAR(red, delta({0, 0, 1}), 1e-9);
    EXPECT_NEAR(3.0 * red, delta({1, 1, 1}), 1e-7);
}

TEST_F(ImageDifference, NamesAlpha) {
    Image opaque(8, 8, 4, 1.0f), half = opaque;
    for (int x = 0; x < 8; ++x) half.at(x, 3)[3] = 0.4f;
    write_png(file("a.png"), opaque), write_png(file("b.png"), half);
    const Difference d = difference(file("a.png"), file("b.png"), {}, "");
    EXPECT_EQ(d.figures.delta, 0.0);
    EXPECT_EQ(d.alpha.differing, 8u);
    EXPECT_NEAR(d.alpha.delta, 0.6 / 8.0, 1e-6);
    EXPECT_TRUE(says(d, "differ in the alpha of 8 of 64 pixels"));
    EXPECT_TRUE(difference(file("b.png"), file("b.png"), {}, "").warnings.empty());

    const Difference of_exr = difference(exr("a.exr", {{"", opaque}}), exr("b.exr", {{"", half}}), {}, "");
    EXPECT_EQ(of_exr.alpha.differing, 8u);
    EXPECT_EQ(difference(file("a.exr"), exr("c.exr", {{"", Image(8, 8, 3, 1.0f)}}), {}, "").alpha.differing,
              0u);
}

// Two gray pictures of 2 x 2 pixels with 16 bits a channel, 0x8000 and 0x8001.
const std::vector<std::uint8_t> wide_gray = {
    137, 80, 78, 71, 13, 10, 26, 10,  0,   0,  0,   13, 73, 72, 68, 82, 0,  0,   0,   2,  0,   0,  0,   2,
    16,  0,  0,  0,  0,  7,  77, 142, 187, 0,  0,   0,  15, 73, 68, 65, 84, 120, 156, 99, 104, 96, 104, 96,
    96,  0,  17, 0,  11, 10, 2,  1,   236, 41, 191, 24, 0,  0,  0,  0,  73, 69,  78,  68, 174, 66, 96,  130};
const std::vector<std::uint8_t> wide_gray_above = {
    137, 80, 78, 71, 13, 10, 26, 10,  0,   0,  0,  13, 73, 72, 68, 82, 0,  0,   0,   2,  0,   0,  0,   2,
    16,  0,  0,  0,  0,  7,  77, 142, 187, 0,  0,  0,  15, 73, 68, 65, 84, 120, 156, 99, 104, 96, 108, 96,
    100, 0,  17, 0,  11, 28, 2,  5,   126, 78, 10, 67, 0,  0,  0,  0,  73, 69,  78,  68, 174, 66, 96,  130};

TEST_F(ImageDifference, LooksAtAllBitsOrSaysThatItDoesNot) {
    write_file(file("a.png"), wide_gray), write_file(file("b.png"), wide_gray_above);
    const Difference d = difference(file("a.png"), file("b.png"), {}, "");
    EXPECT_TRUE(d.figures.delta > 0.0 || says(d, "16 bits"));
    if (d.figures.delta > 0.0) {
        EXPECT_NEAR(d.figures.delta, 1.0 / 65535.0, 1e-7);
    }
}

TEST_F(ImageDifference, CountsWhatIsNotFinite) {
    Image image = ramp({1, 1, 1});
    image.set_rgb(1, 1, glm::vec3(NAN)), image.set_rgb(2, 1, glm::vec3(1.0f, INFINITY, 1.0f));
    const Difference d =
        difference(exr("a.exr", {{"", ramp({1, 1, 1})}}), exr("b.exr", {{"", image}}), {}, "");
    EXPECT_EQ(d.not_finite, 2u);
    EXPECT_TRUE(says(d, "2 of 3072 pixels that count are NaN or infinite (2 in"));
    EXPECT_TRUE(std::isfinite(d.figures.delta));
    // The same pixel of two files is one.
    EXPECT_EQ(difference(file("b.exr"), file("b.exr"), {}, "").not_finite, 2u);
}

TEST_F(ImageDifference, EveryMetricTakesTheMask) {
    Image image = ramp({1, 1, 1}), mask(64, 48, 1, 1.0f);
    for (int y = 0; y < 48; ++y)
        for (int x = 40; x < 64; ++x) image.set_rgb(x, y, glm::vec3(float(x * y % 7))), *mask.at(x, y) = 0.0f;
    image.set_rgb(50, 5, glm::vec3(NAN));
    const auto a = exr("a.exr", {{"", ramp({1, 1, 1})}}), b = exr("b.exr", {{"", image}, {"mask", mask}});
    for (const Difference& d : {difference(a, b, {}, ""), difference(b, a, {}, "")}) {
        EXPECT_EQ(d.counted, 40u * 48u);
        EXPECT_EQ(d.figures.delta, 0.0);
        EXPECT_EQ(d.figures.rmse, 0.0);
        EXPECT_EQ(d.figures.ssim, 1.0);
        EXPECT_EQ(d.figures.flip, 0.0);
        EXPECT_EQ(d.flip.max, 0.0);
        EXPECT_EQ(d.flip_hdr->max, 0.0);
        EXPECT_EQ(d.evaluator_flip, 0.0);
        EXPECT_EQ(d.not_finite, 0u);
        EXPECT_EQ(d.picture.rgb(50, 5), glm::vec3(1.0f));
    }
    EXPECT_TRUE(says(difference(a, exr("c.exr", {{"", image}, {"mask", Image(64, 48, 1)}}), {}, ""),
                     "no pixel counts"));
}

TEST_F(ImageDifference, SaysInWhatPicturesAreNotAlike) {
    Scene scene, other;
    scene.lights.resize(1), other.lights.resize(2);
    scene.environment.radiance = other.environment.radiance = Image(4, 2, 3, 1.0f);
    Camera camera;
    camera.name = "view";
    camera.far = INFINITY;
    const FrameOptions frame;
    const Layers picture = {{"", ramp({1, 1, 1})}};
    Attributes truth = attributes_of(scene, "a.gltf", camera, &frame);
    add_reference(truth, "direct", {.pixel_center = true}, 16);
    const auto warnings = [&](const Attributes& attributes, const std::string& layer = "") {
        return difference(exr("truth.exr", picture, truth), exr("other.exr", picture, attributes), {}, layer);
    };
    Attributes shot = attributes_of(scene, "a.gltf", camera, &frame);
    add_frame(shot, "isr", frame);
    EXPECT_EQ(warnings(shot).warnings.size(), 1u); // the truth has no groups of samples
    EXPECT_TRUE(says(warnings(shot), "no groups of samples"));

    camera.position.x += 0.01f, camera.yfov = 0.8f;
    Attributes moved = attributes_of(scene, "a.gltf", camera, &frame);
    EXPECT_TRUE(says(warnings(moved), "different cameras: position, field of view"));
    ASSERT_TRUE(camera_of(moved));
    EXPECT_EQ(camera_of(moved)->position, camera.position);
    EXPECT_EQ(camera_of(moved)->yfov, camera.yfov);
    EXPECT_EQ(camera_of(moved)->far, camera.far);
    EXPECT_TRUE(says(warnings(attributes_of(other, "b.gltf", camera, &frame)),
                     "different scenes: a.gltf and b.gltf"));
    EXPECT_TRUE(says(warnings(attributes_of(scene, "a.gltf", camera, nullptr)), "by the true environment"));
    Attributes area = truth;
    add_reference(area, "full", {}, 16);
    EXPECT_TRUE(says(warnings(area), "samples pixel centers"));
    EXPECT_TRUE(says(warnings(area), "different light paths"));
}

} // namespace
} // namespace luxel
