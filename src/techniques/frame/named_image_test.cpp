// SPDX-License-Identifier: MIT
#include "techniques/frame/named_image.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "gpu/recorder.h"
#include "shared/cube.h"

namespace luxel {
namespace {

// Six faces whose pixels are the directions that they stand for, times `scale`.
std::vector<Image> directions(int side, float scale) {
    std::vector<Image> faces;
    for (int face = 0; face < 6; ++face) {
        faces.emplace_back(side, side, 3);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                faces.back().set_rgb(x, y,
                                     scale * shared::cube_direction(
                                                 face, (glm::vec2(float(x), float(y)) + 0.5f) / float(side)));
    }
    return faces;
}

// The faces of a cross meet where those of the cube do: from one pixel to the next the direction never moves
// by more than one texel, in the row of four and in the column of three.
TEST(NamedImage, ACrossIsContinuous) {
    constexpr int side = 16;
    const Image cross = unrolled(directions(side, 1.0f), true);
    ASSERT_EQ(cross.width, 4 * side);
    ASSERT_EQ(cross.height, 3 * side);
    const float step = 2.0f / side * 1.01f;
    for (int y = side; y < 2 * side; ++y)
        for (int x = 1; x < 4 * side; ++x)
            EXPECT_LT(glm::length(cross.rgb(x, y) - cross.rgb(x - 1, y)), step) << x << ' ' << y;
    for (int y = 1; y < 3 * side; ++y)
        for (int x = side; x < 2 * side; ++x)
            EXPECT_LT(glm::length(cross.rgb(x, y) - cross.rgb(x, y - 1)), step) << x << ' ' << y;
    EXPECT_EQ(cross.rgb(0, 0), glm::vec3(0.0f));
    EXPECT_GT(cross.rgb(side + side / 2, side + side / 2).z, 0.99f); // +z is in the middle
}

TEST(NamedImage, SeveralCubesAndLayersStandInRows) {
    std::vector<Image> faces = directions(2, 1.0f), more = directions(2, 3.0f);
    faces.insert(faces.end(), more.begin(), more.end());
    const Image two = unrolled(faces, true);
    EXPECT_EQ(two.width, 16);
    EXPECT_EQ(two.height, 6);
    EXPECT_EQ(two.rgb(8 + 2, 2), 3.0f * two.rgb(2, 2));

    std::vector<Image> layers;
    for (int i = 0; i < 5; ++i) layers.emplace_back(3, 2, 1, float(i + 1));
    const Image all = unrolled(layers, false);
    EXPECT_EQ(all.width, 9);
    EXPECT_EQ(all.height, 4);
    EXPECT_EQ(*all.at(8, 0), 3.0f);
    EXPECT_EQ(*all.at(3, 3), 5.0f);
    EXPECT_EQ(*all.at(8, 3), 0.0f);
}

class NamedImageTest : public ::testing::Test {
protected:
    // Each mip and layer filled with layer + 10 mip.
    gpu::Image filled(const gpu::ImageInfo& info, const std::string& name) {
        gpu::Image image = gpu.image(info, name);
        gpu::Recorder recorder(gpu);
        for (std::uint32_t mip = 0; mip < info.mips; ++mip)
            for (std::uint32_t layer = 0; layer < info.layers; ++layer) {
                const float value = float(layer) + 10.0f * float(mip);
                recorder.clear(image.mip(mip).layer(layer), {value, value + 0.5f, 0, 0});
            }
        recorder.submit();
        return image;
    }
    std::string refusal(const std::string& text) {
        try {
            read_named_image(gpu, made, text);
        } catch (const Error& e) {
            return e.what();
        }
        return {};
    }
    gpu::Gpu gpu{{.validation = true}};
    std::vector<gpu::Image> made;
};

TEST_F(NamedImageTest, CubesMipsLayersAndTwoChannels) {
    made = {
        filled({.width = 4, .height = 4, .layers = 6, .cube = true}, "box"),
        filled({.width = 8, .height = 4, .format = VK_FORMAT_R32G32_SFLOAT, .mips = 3}, "flux"),
        filled({.width = 2, .height = 2, .format = VK_FORMAT_R32_SFLOAT, .mips = 2, .layers = 3}, "maps")};
    const Image box = read_named_image(gpu, made, "box");
    EXPECT_EQ(box.width, 16);
    EXPECT_EQ(*box.at(4, 4), 4.0f);  // +z
    EXPECT_EQ(*box.at(15, 7), 5.0f); // -z
    const Image flux = read_named_image(gpu, made, "flux:mip=1");
    EXPECT_EQ(flux.width, 4);
    EXPECT_EQ(flux.height, 2);
    EXPECT_EQ(flux.channels, 2);
    EXPECT_EQ(flux.at(3, 1)[1], 10.5f);
    EXPECT_EQ(read_named_image(gpu, made, "flux").width, 8);
    const Image one = read_named_image(gpu, made, "maps:layer=2,mip=1");
    EXPECT_EQ(one.width, 1);
    EXPECT_EQ(*one.at(0, 0), 12.0f);
    EXPECT_EQ(read_named_image(gpu, made, "maps").width, 4);
    for (const std::string& message : gpu.validation_messages()) ADD_FAILURE() << message;
}

TEST_F(NamedImageTest, RefusalsSayWhatThereIs) {
    made = {filled({.width = 4, .height = 4}, "depth"), filled({.width = 4, .height = 4}, "normal"),
            filled({.width = 8192, .height = 8, .format = VK_FORMAT_R8_UNORM, .layers = 6}, "wide")};
    EXPECT_EQ(refusal("dept"),
              "dept: the frame has no such image; known are depth, normal, wide; did you mean depth?");
    EXPECT_EQ(refusal("depth:mip=1"), "depth: there is no mip 1; it has 1");
    EXPECT_EQ(refusal("depth:layer=1"), "depth: there is no layer 1; it has 1");
    EXPECT_EQ(refusal("depth:lod=1"), "depth: no parameter lod; known are mip, layer");
    EXPECT_EQ(refusal("wide"),
              "wide: 6 layers of 8192x8 are too large for one picture; name one as wide:layer=0");
}

} // namespace
} // namespace luxel
