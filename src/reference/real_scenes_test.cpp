// SPDX-License-Identifier: MIT
// Against images that another renderer computed.
#include <algorithm>

#include <gtest/gtest.h>

#include "reference/reference.h"
#include "reference/test_scenes.h"
#include "scene/load.h"
#include "support/data.h"

namespace luxel {
namespace {

// Means of factor x factor pixels.
Image reduced(const Image& image, int factor) {
    Image small(image.width / factor, image.height / factor, image.channels);
    for (int y = 0; y < small.height * factor; ++y)
        for (int x = 0; x < small.width * factor; ++x)
            for (int c = 0; c < image.channels; ++c)
                small.at(x / factor, y / factor)[c] += image.at(x, y)[c] / float(factor * factor);
    return small;
}

TEST(RealScenes, CornellBoxMatchesTungsten) {
    LUXEL_DATA_OR_SKIP(scene_file, "cornell_box/cornell_box.gltf");
    LUXEL_DATA_OR_SKIP(image_file, "cornell_box/TungstenRender.exr");
    Scene scene = load_scene(scene_file.string());
    RayCaster rays(scene);
    Image published = reduced(read_image(image_file), 16);
    Estimate e = render_reference(rays, testing::request_for({"full"}, scene.cameras[0], 64, 384));
    for (int c = 0; c < 3; ++c) {
        std::vector<double> ratios;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                if (published.at(x, y)[c] > 0.0f)
                    ratios.push_back(double(e.mean["full"].at(x, y)[c] / published.at(x, y)[c]));
        std::nth_element(ratios.begin(), ratios.begin() + std::ptrdiff_t(ratios.size() / 2), ratios.end());
        EXPECT_NEAR(ratios[ratios.size() / 2], 1.0, 0.005) << "channel " << c;
    }
}

} // namespace
} // namespace luxel
