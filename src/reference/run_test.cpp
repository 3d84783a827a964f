// SPDX-License-Identifier: MIT
// How a run goes: threads, stopping, resuming, storing.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/error.h"
#include "core/file.h"
#include "reference/estimate_io.h"
#include "reference/reference.h"
#include "reference/test_scenes.h"

namespace luxel {
namespace {

using namespace testing;

void expect_identical(const Estimate& a, const Estimate& b) {
    EXPECT_EQ(a.spp, b.spp);
    EXPECT_EQ(a.mask.data, b.mask.data);
    for (const auto& [name, image] : a.mean) {
        EXPECT_EQ(image.data, b.mean.at(name).data) << name;
        EXPECT_EQ(a.variance.at(name).data, b.variance.at(name).data) << name;
        for (std::size_t g = 0; g < a.group.size(); ++g)
            EXPECT_EQ(a.group[g].at(name).data, b.group[g].at(name).data) << name;
    }
}

class Run : public ::testing::Test {
protected:
    Run() : scene(cornell()), rays(scene), request(request_for({"full", "ao"}, scene.cameras[0], 20, 48)) {
        file = std::filesystem::path(::testing::TempDir()) /
               (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".luxel");
        std::filesystem::remove(file);
    }
    ~Run() override { std::filesystem::remove(file); }
    Estimate render() { return render_reference(rays, request); }

    Scene scene;
    RayCaster rays;
    ReferenceRequest request;
    std::filesystem::path file;
};

TEST_F(Run, IsTheSameForAnyThreadCount) {
    Estimate many = render();
    for (std::size_t threads : {1u, 2u, 5u}) {
        tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        expect_identical(many, render());
    }
    request.settings.seed = 2;
    EXPECT_NE(many.mean["full"].data, render().mean["full"].data);
}

TEST_F(Run, ResumesToTheIdenticalResult) {
    Estimate straight = render();
    request.checkpoint = file;
    for (int spp : {5, 16, 33, 48}) {
        request.settings.spp = spp;
        Estimate part = render();
        EXPECT_EQ(part.spp, spp);
        EXPECT_TRUE(part.warnings.empty());
        if (spp == 48) expect_identical(straight, part);
    }
}

TEST_F(Run, IgnoresBadCheckpoints) {
    Estimate straight = render();
    request.checkpoint = file;
    request.settings.spp = 16;
    render();
    const std::vector<std::uint8_t> good = read_file(file);
    request.settings.spp = 48;

    auto expect_refused = [&](const std::vector<std::uint8_t>& bytes, const std::string& reason) {
        write_file(file, bytes);
        Estimate e = render();
        ASSERT_EQ(e.warnings.size(), 1u) << reason;
        EXPECT_NE(e.warnings[0].find(reason), std::string::npos) << e.warnings[0];
        expect_identical(straight, e);
    };
    std::vector<std::uint8_t> bytes = good;
    bytes[good.size() / 2] ^= 1;
    expect_refused(bytes, "checksum");
    expect_refused({good.begin(), good.end() - 9}, "truncated");
    expect_refused({}, "too short");
    bytes = good;
    bytes[0] = 'X';
    expect_refused(bytes, "not a checkpoint");

    // Sound, but of something else.
    request.settings.seed = 9;
    write_file(file, good);
    EXPECT_EQ(render().warnings.size(), 1u);
    request.settings.seed = 1;
    scene.materials[0].base_color.r *= 0.5f;
    write_file(file, good);
    EXPECT_EQ(render().warnings.size(), 1u);
}

TEST_F(Run, GroupsAverageToTheMean) {
    request.settings.spp = 7;
    Estimate e = render();
    for (std::size_t i = 0; i < e.mean["full"].data.size(); ++i) {
        float mean = e.group[3]["full"].data[i] / 7.0f;
        for (std::size_t g = 0; g < 3; ++g) mean += 2.0f * e.group[g]["full"].data[i] / 7.0f;
        EXPECT_NEAR(mean, e.mean["full"].data[i], 1e-5f * std::max(1.0f, mean));
    }
}

// The variance that a run states is the one that repeated runs show.
TEST_F(Run, StatesItsVarianceCorrectly) {
    double stated = 0.0, sum = 0.0, squares = 0.0;
    const int runs = 40;
    request.settings.spp = 8;
    for (int seed = 1; seed <= runs; ++seed) {
        request.settings.seed = seed;
        Measured m = measure(render(), "full");
        stated += m.error * m.error / runs;
        sum += m.mean, squares += m.mean * m.mean;
    }
    double shown = (squares - sum * sum / runs) / (runs - 1);
    EXPECT_NEAR(shown / stated, 1.0,
                0.75); // 3.3 standard deviations of chi-squared with 39 degrees of freedom
}

// The error that a long run knows, from runs of other seeds: what --error asks for is what is reached, with
// hardly more samples than that takes.
TEST_F(Run, StopsAtTheErrorThatItIsAskedFor) {
    request = request_for({"full"}, scene.cameras[0], 16, 4096);
    request.settings.seed = 1000;
    const Estimate truth = render();
    // Mean over pixels of the root mean square, over runs, of their distance to the truth.
    const auto true_error = [&](int spp) {
        constexpr int runs = 16;
        request.settings.spp = spp, request.settings.error = 0.0f;
        std::vector<double> squares(truth.mask.pixels(), 0.0);
        for (int seed = 1; seed <= runs; ++seed) {
            request.settings.seed = seed;
            const Estimate e = render();
            for (std::size_t i = 0; i < squares.size(); ++i) {
                const int x = int(i) % truth.width, y = int(i) / truth.width;
                const double r = double(luminance(truth.mean.at("full").rgb(x, y)));
                squares[i] += std::pow(double(luminance(e.mean.at("full").rgb(x, y))) / r - 1.0, 2.0) / runs;
            }
        }
        double sum = 0.0;
        for (const double s : squares) sum += std::sqrt(s) / double(squares.size());
        return sum;
    };
    const auto stops_at = [&](float error) {
        request.settings.spp = 1 << 14, request.settings.error = error, request.settings.seed = 1;
        return render().spp;
    };
    for (const float error : {0.15f, 0.1f}) {
        const int spp = stops_at(error);
        EXPECT_NEAR(true_error(spp) / double(error), 1.0, 0.1) << spp << " samples for " << error;
    }
}

TEST_F(Run, AnErrorTakesSomeSamplesToBeKnown) {
    // Asked for both, a run must not take what one sample says for its error.
    request.settings.spp = 256, request.settings.seconds = 60.0f, request.settings.error = 0.9f;
    const Estimate e = render();
    EXPECT_EQ(e.spp, samples_for_error);
    ASSERT_TRUE(relative_error(e));
    EXPECT_GT(relative_error(e)->value, 0.01);
    EXPECT_GT(relative_error(e)->uncertainty, 0.0);

    request.settings = {.spp = 7};
    EXPECT_FALSE(relative_error(render()));
    // The same target gives the same samples, whether the clock looks on or not; a run that is there stays
    // there.
    request.settings = {.spp = 1024, .error = 0.2f};
    const int spp = render().spp;
    EXPECT_GT(spp, samples_for_error);
    request.settings.seconds = 600.0f;
    EXPECT_EQ(render().spp, spp);
    request.checkpoint = file;
    EXPECT_EQ(render().spp, spp);
    EXPECT_EQ(render().spp, spp);
}

TEST_F(Run, StopsWhenItsTimeIsUp) {
    request.settings.spp = 1 << 24;
    request.settings.seconds = 0.1f;
    Estimate e = render();
    EXPECT_GE(e.spp, 1);
    EXPECT_LT(e.spp, 1 << 24);
}

TEST_F(Run, PixelCentersSeeTheSamePointEachTime) {
    // A light that is seen directly is constant within its pixels, so only pixels on its border may vary.
    scene.materials =
        std::vector<Material>(scene.materials.size(), lambertian(glm::vec3(0.0f), glm::vec3(1.0f)));
    request.settings.pixel_center = true;
    Estimate e = render();
    for (float v : e.variance["full"].data) EXPECT_EQ(v, 0.0f);
}

TEST_F(Run, EstimatesSurviveTheirFile) {
    Estimate e = render();
    file.replace_extension(".exr");
    write_estimate(file, e, {{"luxel.key", "abc"}});
    StoredEstimate stored = read_estimate(file);
    expect_identical(e, stored.estimate);
    EXPECT_EQ(stored.metadata["luxel.key"], "abc");

    write_exr(file, {{"full", Image(2, 2, 3)}});
    EXPECT_THROW(read_estimate(file), Error);
}

} // namespace
} // namespace luxel
