// SPDX-License-Identifier: MIT
// results.json against docs/results-schema.md, the files beside it, and the re-use of cached references.
#include <cmath>
#include <map>
#include <regex>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/build_folders.h"
#include "support/luxel_process.h"

namespace luxel::testing {
namespace {

using Json = nlohmann::json;

// Field -> type, from the table under a heading of the schema's page.
std::map<std::string, std::string> documented_fields(const std::string& heading) {
    const std::string page = slurp(LUXEL_SOURCE_DIR "/docs/results-schema.md");
    const std::size_t begin = page.find("\n## " + heading + "\n");
    const std::string section = page.substr(begin, page.find("\n## ", begin + 1) - begin);
    std::map<std::string, std::string> fields;
    const std::regex row("\n\\| (`[^|]*) \\| ([^|]*) \\|"), name("`([a-z_]+)`");
    for (std::sregex_iterator r(section.begin(), section.end(), row), end; r != end; ++r) {
        const std::string names = (*r)[1];
        for (std::sregex_iterator n(names.begin(), names.end(), name); n != end; ++n)
            fields[(*n)[1]] = (*r)[2];
    }
    return fields;
}

bool has_type(const Json& value, const std::string& type) {
    if (type == "text") return value.is_string();
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    if (type == "number or null") return value.is_number() || value.is_null();
    if (type == "boolean") return value.is_boolean();
    if (type == "text or null") return value.is_string() || value.is_null();
    if (type == "object or null") return value.is_object() || value.is_null();
    if (type == "object") return value.is_object();
    if (type.starts_with("array")) return value.is_array();
    if (type == "[integer, integer]")
        return value.is_array() && value.size() == 2 && value[0].is_number_integer();
    return false;
}

// Every documented field is there with its type, and nothing else is.
void expect_documented(const Json& object, const std::string& heading) {
    const auto fields = documented_fields(heading);
    ASSERT_GE(fields.size(), 5u) << heading;
    std::set<std::string> present, documented;
    for (const auto& [key, value] : object.items()) present.insert(key);
    for (const auto& [name, type] : fields) {
        documented.insert(name);
        if (!object.contains(name)) continue;
        EXPECT_TRUE(has_type(object[name], type)) << heading << ": " << name << " is no " << type;
    }
    EXPECT_EQ(present, documented) << heading;
}

// Without what differs between two runs of the same evaluation: times, and where the reference came from.
Json without_times(Json json) {
    const std::set<std::string> times = {"ms", "cost", "seconds", "cached"};
    for (auto& [key, value] : json.items()) {
        if (times.count(key))
            value = nullptr;
        else if (value.is_structured())
            value = without_times(value);
    }
    return json;
}

class ResultsTest : public ::testing::Test {
protected:
    ProcessResult evaluate(const std::string& name, std::vector<std::string> more = {}) {
        std::vector<std::string> arguments = {"evaluate",
                                              "builtin:shapes-point",
                                              "--use",
                                              "isr:samples=24",
                                              "--size",
                                              "96x64",
                                              "--spp",
                                              "4",
                                              "--quiet",
                                              "--cache",
                                              (folder_.path() / "cache").string(),
                                              "-o",
                                              (folder_.path() / name).string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_luxel(arguments);
    }
    Json results(const std::string& name) {
        return Json::parse(slurp(folder_.path() / name / "results.json"));
    }
    // Of the one scene.
    Json views(const std::string& name) { return results(name).at("scenes")[0].at("views"); }
    std::filesystem::path cached_file() {
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "cache"))
            return entry.path();
        return {};
    }
    TemporaryFolder folder_;
};

TEST_F(ResultsTest, FollowTheDocumentedSchema) {
    const ProcessResult run = evaluate("a", {"--json"});
    ASSERT_EQ(run.code, 0) << run.error;
    const Json json = results("a");
    EXPECT_EQ(Json::parse(run.out), json);

    expect_documented(json, "The file");
    ASSERT_EQ(json.at("scenes").size(), 1u);
    expect_documented(json.at("scenes")[0], "A scene");
    ASSERT_FALSE(json.at("scenes")[0].at("views").empty());
    for (const Json& view : json.at("scenes")[0].at("views")) {
        expect_documented(view, "A view");
        ASSERT_EQ(view.at("techniques").size(), 2u);
        EXPECT_EQ(view.at("techniques")[0].at("name"), "direct");
        EXPECT_EQ(view.at("techniques")[1].at("name"), "isr");
        EXPECT_EQ(view.at("techniques")[1].at("parameters").at("samples"), 24);
        for (const Json& technique : view.at("techniques")) expect_documented(technique, "A technique");
    }
    ASSERT_EQ(json.at("mean").size(), 2u);
    for (const Json& technique : json.at("mean")) expect_documented(technique, "A technique");
    EXPECT_EQ(json.at("mean"), json.at("scenes")[0].at("mean"));
    ASSERT_EQ(json.at("summary").size(), 1u);
    expect_documented(json.at("summary")[0], "A summary");
}

TEST_F(ResultsTest, MeanIsTheMeanOfTheViews) {
    ASSERT_EQ(evaluate("a", {"--views", "2"}).code, 0);
    const Json json = results("a");
    for (const char* figure : {"delta", "gain", "rho", "improved", "rmse", "flip", "ms"}) {
        double sum = 0;
        for (const Json& view : views("a")) sum += view.at("techniques")[1].at(figure).get<double>();
        EXPECT_NEAR(json.at("mean")[1].at(figure).get<double>(), sum / 2, 1e-9 * std::abs(sum)) << figure;
    }
}

TEST_F(ResultsTest, BesideThemAreReportAndImages) {
    ASSERT_EQ(evaluate("a").code, 0);
    const std::string page = slurp(folder_.path() / "a" / "report.html");
    EXPECT_NE(page.find("data:image/jpeg;base64,/9j/"), std::string::npos);
    // Self-contained: nothing is fetched.
    for (const char* fetch : {"src=\"http", "href=\"http", "url(http", "@import"})
        EXPECT_EQ(page.find(fetch), std::string::npos) << fetch;

    const std::string view = views("a")[0].at("name");
    const std::filesystem::path images = folder_.path() / "a" / "images" / view;
    for (const char* name : {"reference", "direct", "isr_samples_24"})
        for (const char* ending : {".exr", ".png"})
            EXPECT_TRUE(std::filesystem::exists(images / (std::string(name) + ending)));

    // What is stored is what was measured.
    const ProcessResult diff =
        run_luxel({"diff", (images / "reference.exr").string(), (images / "isr_samples_24.exr").string(),
                   "--baseline", (images / "direct.exr").string(), "--json"});
    ASSERT_EQ(diff.code, 0) << diff.error;
    const Json figures = Json::parse(diff.out), measured = views("a")[0].at("techniques")[1];
    EXPECT_NEAR(figures.at("ssim").get<double>(), measured.at("ssim").get<double>(), 1e-6);
    // The reference's groups of samples are in its file: what its noise adds is taken out of both.
    for (const char* figure : {"delta", "rmse", "gain", "gain_error"})
        EXPECT_NEAR(figures.at(figure).get<double>(), measured.at(figure).get<double>(),
                    1e-6 * std::abs(measured.at(figure).get<double>()) + 1e-9)
            << figure;
}

TEST_F(ResultsTest, ASecondRunTakesTheReferenceFromTheCache) {
    ASSERT_EQ(evaluate("a").code, 0);
    ASSERT_EQ(evaluate("b").code, 0);
    EXPECT_FALSE(views("a")[0].at("reference").at("cached"));
    EXPECT_TRUE(views("b")[0].at("reference").at("cached"));
    EXPECT_EQ(without_times(results("a")), without_times(results("b")));

    // Another seed is another reference; a sum of the usual components is not.
    ASSERT_EQ(evaluate("c", {"--seed", "2"}).code, 0);
    EXPECT_FALSE(views("c")[0].at("reference").at("cached"));
    ASSERT_EQ(evaluate("d", {"--component", "diffuse1"}).code, 0);
    EXPECT_TRUE(views("d")[0].at("reference").at("cached"));
}

TEST_F(ResultsTest, OcclusionAsTruthIsMeasuredOnLinearAccessibility) {
    ASSERT_EQ(evaluate("a", {"--component", "ao", "--ao-radius", "0.5", "--ao-membership", "cubic", "--use",
                             "isr:ao_radius=0.5"})
                  .code,
              0);
    const Json json = results("a"), view = views("a")[0];
    EXPECT_EQ(json.at("ao"), Json({{"radius", 0.5}, {"membership", "cubic"}}));
    EXPECT_EQ(view.at("exposure"), 1);

    // Against an image that is open everywhere, delta is the mean occlusion, which RMSE bounds.
    const Json open = view.at("techniques")[0], isr = view.at("techniques")[2];
    EXPECT_EQ(open.at("rho"), 0);
    EXPECT_GT(open.at("delta"), 0.001);
    EXPECT_LT(open.at("delta"), 0.3);
    EXPECT_GE(open.at("rmse"), open.at("delta"));
    EXPECT_GT(isr.at("rho"), 0.2);

    // Light is no part of it.
    ASSERT_EQ(evaluate("b").code, 0);
    EXPECT_TRUE(results("b").at("ao").is_null());
    const ProcessResult misplaced = evaluate("c", {"--ao-radius", "1"});
    EXPECT_EQ(misplaced.code, 2);
    EXPECT_EQ(misplaced.error_lines(), 1u) << misplaced.error;
    EXPECT_EQ(evaluate("d", {"--component", "ao", "--ao-membership", "wide"}).code, 2);
    EXPECT_EQ(evaluate("e", {"--component", "ao+direct"}).code, 2);
}

TEST_F(ResultsTest, ADamagedCacheIsRebuiltWithAWarning) {
    ASSERT_EQ(evaluate("a").code, 0);
    std::string bytes = slurp(cached_file());
    bytes[bytes.size() / 2] ^= 1;
    spill(cached_file(), bytes);
    const ProcessResult run = evaluate("b");
    EXPECT_EQ(run.code, 0);
    EXPECT_NE(run.error.find("luxel: warning: "), std::string::npos) << run.error;
    EXPECT_EQ(run.error_lines(), 1u) << run.error;
    EXPECT_FALSE(views("b")[0].at("reference").at("cached"));
    ASSERT_EQ(evaluate("c").code, 0);
    EXPECT_TRUE(views("c")[0].at("reference").at("cached"));
}

TEST(Diff, RefusesImagesOfOtherSizeOrKind) {
    const TemporaryFolder folder;
    const auto file = [&](const char* name) { return (folder.path() / name).string(); };
    for (const auto& [name, size] : {std::pair("a.png", "16x16"), {"b.png", "16x8"}, {"a.exr", "16x16"}})
        ASSERT_EQ(
            run_luxel({"reference", "builtin:cornell", "--size", size, "--spp", "1", "-o", file(name)}).code,
            0);

    for (const char* other : {"b.png", "a.exr"}) {
        const ProcessResult result = run_luxel({"diff", file("a.png"), file(other)});
        EXPECT_EQ(result.code, 4);
        EXPECT_EQ(result.error_lines(), 1u) << result.error;
    }
    const Json same = Json::parse(run_luxel({"diff", file("a.exr"), file("a.exr"), "--json"}).out);
    EXPECT_EQ(same.at("delta"), 0);
    EXPECT_EQ(same.at("flip_hdr").at("mean"), 0);
    EXPECT_TRUE(same.at("psnr").is_null());
}

} // namespace
} // namespace luxel::testing
