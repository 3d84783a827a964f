// SPDX-License-Identifier: MIT
// Light that falls through what a tracer does not know [Le2014, 4.1.2].
#include <gtest/gtest.h>

#include "scene/procedural.h"
#include "support/gpu.h"
#include "techniques/photon_map/test_photons.h"

namespace luxel {
namespace {

class PhotonLeakTest : public testing::GpuTest {
protected:
    // Share of the light that arrives below the upper platform of the occluded ring, where none can.
    double leaked(PhotonTracer tracer, int layers, PhotonCapture capture) {
        PhotonOptions options;
        options.tracer = tracer, options.layers = layers, options.capture = capture;
        double below = 0, all = 0;
        for (const shared::Photon& p : photons_of(gpu(), occluded_ring(), options)) {
            if (p.state != shared::PHOTON_ARRIVED) continue;
            all += p.power.g;
            const bool under = p.position.z < 0.1f && std::abs(p.position.x) < 0.98f && p.position.y < 0.5f;
            if (under) below += p.power.g;
        }
        EXPECT_GT(all, 0.1);
        return below / all;
    }
};

// From the camera four walls hide the platform: four layers end before it. Lists have it, and eight layers
// do.
TEST_F(PhotonLeakTest, ListsKnowThePlatform) {
    for (PhotonCapture capture : {PhotonCapture::camera, PhotonCapture::box}) {
        EXPECT_LT(leaked(PhotonTracer::march, 4, capture), 0.01);
        EXPECT_LT(leaked(PhotonTracer::lines, 4, capture), 0.01);
        EXPECT_LT(leaked(PhotonTracer::layers, 8, capture), 0.01);
    }
    EXPECT_GT(leaked(PhotonTracer::layers, 4, PhotonCapture::camera), 0.5);
}

} // namespace
} // namespace luxel
