// SPDX-License-Identifier: MIT
// Figures say how wrong an image is, not under which lamp it was taken.
#include <cmath>

#include <gtest/gtest.h>

#include "experiments/figures.h"

namespace luxel {
namespace {

// A gray wall under a lamp of some color: light falls off to the right, and `ambient` of it comes back from
// around.
Image wall(glm::vec3 lamp, float ambient) {
    Image image(96, 64, 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            image.set_rgb(x, y, lamp * (std::exp(-float(x) / 24.0f) + ambient * (0.5f + float(y) / 128.0f)));
    return image;
}

Figures under(glm::vec3 lamp) {
    Truth truth;
    truth.mean["full"] = wall(lamp, 0.3f);
    truth.mask = Image(96, 64, 1, 1.0f);
    const Target target = make_target(truth, {"full"}, truth.mask);
    return measure(target, make_candidate(target, wall(lamp, 0.0f)),
                   make_candidate(target, wall(lamp, 0.2f)));
}

TEST(Figures, TheGainDoesNotDependOnTheColorOfTheLamp) {
    const Figures white = under(glm::vec3(2.0f));
    EXPECT_GT(white.gain, 20.0);
    EXPECT_LT(white.gain, 80.0);
    for (const glm::vec3 lamp : {glm::vec3(2, 0, 0), glm::vec3(0, 2, 0), glm::vec3(0, 0, 2)}) {
        const Figures colored = under(lamp);
        EXPECT_NEAR(colored.gain, white.gain, 0.01);
        EXPECT_NEAR(colored.improved, white.improved, 1e-3);
        EXPECT_NEAR(3.0 * colored.delta, white.delta, 1e-5); // two of three channels are equally black
    }
}

} // namespace
} // namespace luxel
