// SPDX-License-Identifier: MIT
// Ground-truth ambient occlusion: its inner integrals by quadrature, its bent normals on planes and before a
// wall. What all techniques of the slot share is tested in tests/.
#include "techniques/gtao/gtao.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/analytic_frame.h"
#include "support/gpu.h"

namespace luxel {
namespace {

TEST(GtaoIntegrals, AreThoseOfAQuadrature) {
    for (float gamma : {-1.4f, -0.6f, 0.0f, 0.3f, 1.2f})
        for (float h : {0.1f, 0.7f, 1.3f}) {
            constexpr int n = 4000;
            double open = 0, across = 0, along = 0;
            for (int i = 0; i < n; ++i) {
                double t = double(h) * (i + 0.5) / n,
                       w = std::cos(t - double(gamma)) * std::sin(t) * double(h) / n;
                open += w, across += w * std::sin(t), along += w * std::cos(t);
            }
            EXPECT_NEAR(shared::gtao_arc(h, gamma), open, 1e-5);
            EXPECT_NEAR(shared::gtao_bent_arc(h, gamma).x, across, 1e-5);
            EXPECT_NEAR(shared::gtao_bent_arc(h, gamma).y, along, 1e-5);
        }
}

class GtaoBentNormals : public testing::GpuTest {
protected:
    Image bent(const testing::AnalyticFrame& a, const std::string& more) {
        Gtao gtao;
        set_parameters(gtao, "gtao",
                       {{"bent_normals", "on"}, {"samples", "32"}, {"resolution", more}, {"radius", "1"}});
        gpu::Recorder recorder(gpu());
        gtao.render(recorder, a.frame);
        recorder.submit();
        for (const gpu::Image& image : recorder.images())
            if (image.name() == "gtao bent normal") return gpu().read(image);
        ADD_FAILURE() << "no bent normals";
        return {};
    }
    static Camera camera() {
        Camera c;
        c.position = {-6, 6, 0}, c.yfov = 0.47f, c.forward = glm::normalize(glm::vec3(1, -1, 0));
        return c;
    }
};

TEST_F(GtaoBentNormals, AreTheNormalOnAPlane) {
    testing::AnalyticFrame a = testing::analytic_frame(gpu(), camera(), 64, 64, {{glm::vec3(0), {0, 1, 0}}});
    for (const char* resolution : {"full", "half"}) {
        Image b = bent(a, resolution);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) EXPECT_GT(b.rgb(x, y).y, 0.9999f);
    }
}

// At the foot of a wall x = 0 half of the hemisphere is open: 1/pi integral w cos dw = (-2/(3 pi), 1/3),
// before normalization.
TEST_F(GtaoBentNormals, TurnAwayFromAWall) {
    testing::AnalyticFrame a = testing::analytic_frame(
        gpu(), camera(), 128, 128, {{glm::vec3(0), {0, 1, 0}}, {glm::vec3(0), {-1, 0, 0}}});
    Image b = bent(a, "full");
    glm::vec3 expected = glm::normalize(glm::vec3(-2.0f / (3.0f * shared::PI), 1.0f / 3.0f, 0));
    int checked = 0;
    for (int y = 0; y < 128; ++y)
        for (int x = 40; x < 88; ++x) {
            std::size_t i = a.index(x, y);
            if (a.plane[i] != 0 || a.position[i].x < -0.08f || a.position[i].x > -0.03f) continue;
            EXPECT_GT(glm::dot(b.rgb(x, y), expected), std::cos(0.12f)) << b.rgb(x, y).x;
            ++checked;
        }
    EXPECT_GT(checked, 20);
}

} // namespace
} // namespace luxel
