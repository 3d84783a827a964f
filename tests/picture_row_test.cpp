// SPDX-License-Identifier: MIT
// A picture from elsewhere as a row of an evaluation.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include <nlohmann/json.hpp>

#include "core/image_io.h"
#include "support/luxel_process.h"

namespace luxel::testing {
namespace {

using Json = nlohmann::json;

class PictureRowTest : public ::testing::Test {
protected:
    ProcessResult evaluate(const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> all = {"evaluate",
                                        "builtin:cornell",
                                        "--size",
                                        "32x24",
                                        "--spp",
                                        "16",
                                        "--quiet",
                                        "--frames",
                                        "5",
                                        "--cache",
                                        (folder.path() / "cache").string(),
                                        "-o",
                                        (folder.path() / name).string()};
        all.insert(all.end(), more.begin(), more.end());
        return run_luxel(all);
    }
    Json rows(const std::string& name) {
        return Json::parse(
            slurp(folder.path() / name / "results.json"))["scenes"][0]["views"][0]["techniques"];
    }
    // The first evaluation's picture of that name, changed and stored as a file of its own.
    std::string changed(const std::string& name, const std::function<void(Image&)>& change) {
        Image image = read_image(folder.path() / "first" / "images" / "camera" / (name + ".exr"));
        change(image);
        const std::filesystem::path file = folder.path() / "a, b+c.exr";
        write_exr(file, {{"", image}});
        return file.string();
    }
    TemporaryFolder folder;
};

TEST_F(PictureRowTest, HasTheFiguresThatItsPixelsHave) {
    ASSERT_EQ(evaluate("first", {}).code, 0);
    // Direct light's own picture has direct light's figures, and so no gain.
    const std::string same = changed("direct", [](Image&) {});
    ASSERT_EQ(evaluate("same", {"--image", "mine=" + same}).code, 0);
    const Json direct = rows("same")[0], mine = rows("same")[1];
    EXPECT_EQ(mine["name"], "image");
    EXPECT_EQ(mine["label"], "mine");
    EXPECT_EQ(mine["parameters"]["file"], same);
    for (const char* figure : {"delta", "rho", "rmse", "relmse", "ssim", "flip"})
        EXPECT_DOUBLE_EQ(mine[figure].get<double>(), direct[figure].get<double>()) << figure;
    EXPECT_EQ(mine["gain"], 0.0);
    EXPECT_NE(slurp(folder.path() / "same" / "report.html").find("\"label\":\"mine\""), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "same" / "images" / "camera" / "mine.exr"));

    // The truth itself, 1 % too bright, is 1 % of its own root mean square away, and all but 1 % of the error
    // is gone.
    double squares = 0, count = 0;
    const Image mask =
        read_exr(folder.path() / "first" / "images" / "camera" / "reference.exr").layers.at("mask");
    const std::string bright = changed("reference", [&](Image& image) {
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                if (*mask.at(x, y) == 0.0f) continue;
                for (int c = 0; c < 3; ++c) squares += std::pow(double(image.rgb(x, y)[c]), 2), ++count;
            }
        for (float& value : image.data) value *= 1.01f;
    });
    ASSERT_EQ(evaluate("bright", {"--image", "mine=" + bright}).code, 0);
    EXPECT_GT(rows("bright")[1]["gain"], 90.0);
    EXPECT_GT(rows("bright")[1]["rho"], 0.999);
}

TEST_F(PictureRowTest, WhatCannotBeMeasuredIsOneSentence) {
    ASSERT_EQ(evaluate("first", {}).code, 0);
    const auto refusal = [&](const std::string& option, int code) {
        const ProcessResult result = evaluate("refused", {"--image", option});
        EXPECT_EQ(result.code, code) << result.error;
        EXPECT_EQ(result.error_lines(), 1u) << result.error;
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "refused" / "results.json"));
        return result.error;
    };
    const auto says = [](const std::string& sentence, const std::string& part) {
        EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
    };
    says(refusal("mine", 2), "NAME=FILE");
    says(refusal("mine=" + (folder.path() / "none.exr").string(), 6), "none.exr");
    says(refusal("mine=" + (folder.path() / "first/images/camera/direct.png").string(), 4), "display values");
    std::string file = changed("direct", [](Image& image) { image = Image(16, 24, 3, 0.5f); });
    says(refusal("mine=" + file, 4), "it is 16x24 pixels where view 'camera' is 32x24");
    file =
        changed("direct", [](Image& image) { image.at(3, 5)[1] = std::numeric_limits<float>::quiet_NaN(); });
    says(refusal("mine=" + file, 4), "pixel (3, 5) is not a finite number");

    // Several views need a file each.
    const ProcessResult two = evaluate("two", {"--views", "2", "--image", "mine=" + file});
    EXPECT_EQ(two.code, 2);
    says(two.error, "{view}");
}

TEST_F(PictureRowTest, EachViewHasItsFile) {
    ASSERT_EQ(evaluate("first", {"--views", "2"}).code, 0);
    const std::string pattern = (folder.path() / "first/images/{view}/direct.exr").string();
    ASSERT_EQ(evaluate("each", {"--views", "2", "--image", "mine=" + pattern}).code, 0);
    for (const Json& view : Json::parse(slurp(folder.path() / "each/results.json"))["scenes"][0]["views"]) {
        EXPECT_EQ(view["techniques"][1]["gain"], 0.0);
        EXPECT_GT(view["techniques"][1]["delta"], 0.0);
    }

    // A picture of another camera, which luxel's own files name, is not of this view.
    const std::string other = (folder.path() / "first/images/seed_1_view_1/direct.exr").string();
    ASSERT_TRUE(std::filesystem::exists(other));
    const ProcessResult wrong =
        evaluate("wrong", {"--views", "2", "--view", "1", "--image", "mine=" + other});
    EXPECT_EQ(wrong.code, 4);
    EXPECT_NE(wrong.error.find("different cameras"), std::string::npos) << wrong.error;
}

} // namespace
} // namespace luxel::testing
