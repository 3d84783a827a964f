// SPDX-License-Identifier: MIT
// One truth for figures: what evaluate measures is what diff measures on the files of reference and render.
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/luxel_process.h"

namespace luxel::testing {
namespace {

using Json = nlohmann::json;

class DiffFigures : public ::testing::Test {
protected:
    std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
    ProcessResult run(std::vector<std::string> arguments) {
        if (arguments[0] != "diff") arguments.insert(arguments.end(), {"--size", "64x48", "--quiet"});
        return run_luxel(arguments);
    }
    void make(const std::vector<std::string>& arguments) {
        const ProcessResult result = run(arguments);
        ASSERT_EQ(result.code, 0) << result.error;
    }
    TemporaryFolder folder_;
};

TEST_F(DiffFigures, AgreesWithEvaluate) {
    const std::vector<std::string> reference = {"reference",       "builtin:cornell", "--component",
                                                "direct+diffuse1", "--spp",           "16"};
    const auto written = [&](std::vector<std::string> more) {
        std::vector<std::string> all = reference;
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    make(written({"--sampling", "center", "-o", file("truth.exr")}));
    make(written({"-o", file("area.exr")}));
    make({"render", "builtin:cornell", "-o", file("direct.exr")});
    make({"render", "builtin:cornell", "--use", "isr", "-o", file("isr.exr")});
    make({"evaluate", "builtin:cornell", "--use", "isr", "--spp", "16", "--no-cache", "-o", file("out")});
    const Json view = Json::parse(slurp(file("out/results.json"))).at("scenes")[0].at("views")[0];
    const Json row = view.at("techniques")[1];

    const ProcessResult result =
        run({"diff", file("truth.exr"), file("isr.exr"), "--baseline", file("direct.exr"), "--json"});
    ASSERT_EQ(result.code, 0) << result.error;
    EXPECT_EQ(result.error, "");
    const Json diff = Json::parse(result.out);
    for (const char* key :
         {"delta", "gain", "gain_error", "rho", "improved", "tied", "rmse", "relmse", "psnr", "ssim"})
        EXPECT_NEAR(diff.at(key), row.at(key), 1e-6 * std::max(1.0, std::abs(double(row.at(key))))) << key;
    EXPECT_NEAR(diff.at("flip").at("mean"), row.at("flip"), 1e-6);
    EXPECT_NEAR(diff.at("exposure"), view.at("exposure"), 1e-5);
    EXPECT_NEAR(diff.at("noise"), view.at("reference").at("noise"), 1e-7);
    EXPECT_GT(diff.at("gain_error"), 0.1);
    EXPECT_GT(diff.at("delta_error"), 1e-5);
    EXPECT_LT(diff.at("counted"), diff.at("pixels")); // the background does not count

    // The files of evaluate itself say the same.
    const std::string images = file("out/images/camera/");
    const ProcessResult own = run({"diff", images + "reference.exr", images + "isr.exr", "--baseline",
                                   images + "direct.exr", "--json"});
    ASSERT_EQ(own.code, 0) << own.error;
    EXPECT_NEAR(Json::parse(own.out).at("gain"), row.at("gain"), 1e-4);

    // Another sampling is another picture, and is said to be.
    const ProcessResult mixed = run({"diff", file("area.exr"), file("isr.exr"), "--json"});
    EXPECT_NE(mixed.error.find("samples pixel areas"), std::string::npos) << mixed.error;
    EXPECT_NE(Json::parse(mixed.out).at("delta"), diff.at("delta"));

    // Two estimates: their noises may be the same, so that neither is taken out.
    const ProcessResult same = run({"diff", file("truth.exr"), file("truth.exr"), "--json"});
    EXPECT_EQ(Json::parse(same.out).at("delta"), 0);
    EXPECT_NE(same.error.find("estimate, too"), std::string::npos) << same.error;

    // A person reads how sure it is.
    const ProcessResult text =
        run({"diff", file("truth.exr"), file("isr.exr"), "--baseline", file("direct.exr")});
    EXPECT_NE(text.out.find(" +- "), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("pixels that count"), std::string::npos) << text.out;
}

TEST_F(DiffFigures, NoFigureWithoutItsConditions) {
    EXPECT_EQ(run({"reference", "builtin:cornell", "--exposure", "nan", "-o", file("a.png")}).code, 2);
    EXPECT_EQ(run({"render", "builtin:cornell", "--exposure", "inf", "-o", file("a.png")}).code, 2);
    EXPECT_EQ(run({"reference", "builtin:cornell", "--error", "nan", "-o", file("a.png")}).code, 2);
    EXPECT_EQ(run({"reference", "builtin:cornell", "--sampling", "corner", "-o", file("a.png")}).code, 2);

    // One sample says nothing about its error.
    const ProcessResult one =
        run({"reference", "builtin:cornell", "--spp", "1", "-o", file("a.png"), "--json"});
    ASSERT_EQ(one.code, 0) << one.error;
    EXPECT_TRUE(Json::parse(one.out).at("relative_error").is_null());
    EXPECT_EQ(Json::parse(one.out).at("sampling"), "area");

    const ProcessResult first = run({"render", "builtin:cornell", "-o", file("a.png")});
    EXPECT_NE(first.out.find("first frame"), std::string::npos) << first.out;
    const Json timed =
        Json::parse(run({"render", "builtin:cornell", "--frames", "3", "-o", file("a.png"), "--json"}).out);
    EXPECT_EQ(timed.at("frames"), 3);
    EXPECT_TRUE(timed.at("warm"));
    EXPECT_LE(timed.at("ms_least"), timed.at("ms"));
    EXPECT_LE(timed.at("ms"), timed.at("ms_most"));
}

} // namespace
} // namespace luxel::testing
