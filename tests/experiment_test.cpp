// SPDX-License-Identifier: MIT
// luxel experiment: resumed after kills, changed between runs, and the truths ahead of it.
#include <chrono>
#include <random>
#include <regex>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/process.h"
#include "support/build_folders.h"
#include "support/luxel_process.h"

namespace luxel::testing {
namespace {

constexpr const char* small_experiment = R"toml(
size = "48x36"
frames = 1
pictures = "none"
[truth]
spp = 8
[[technique]]
use = "isr"
sweep = { samples = [8, 24] }
[[scene]]
source = "builtin:cornell"
group = "box"
[[scene.views]]
count = 3
[[scene]]
source = "builtin:shapes-point"
[[scene.views]]
count = 2
[[scene.views]]
size = "64x48"
)toml";

class ExperimentTest : public ::testing::Test {
protected:
    void write(const std::string& text) { folder_.add("small.toml", text); }
    std::vector<std::string> arguments(const std::string& name) {
        return {"experiment",
                (folder_.path() / "small.toml").string(),
                "--quiet",
                "--cache",
                (folder_.path() / name / "cache").string(),
                "-o",
                (folder_.path() / name).string()};
    }
    ProcessResult run(const std::string& name, const std::vector<std::string>& more = {}) {
        std::vector<std::string> all = arguments(name);
        all.insert(all.end(), more.begin(), more.end());
        return run_luxel(all);
    }
    // Without the times, the last nine columns.
    std::string figures(const std::string& name) {
        const std::string csv = slurp(folder_.path() / name / "results.csv");
        return std::regex_replace(csv, std::regex("(,[^,\n]*){9}\n"), "\n");
    }
    std::size_t finished(const std::string& name) {
        std::size_t count = 0;
        std::error_code absent;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / name / "views", absent))
            count += entry.path().extension() == ".json";
        return count;
    }
    // Begins the run and kills it after a while. False when it was done before.
    bool run_and_kill(const std::string& name, std::chrono::milliseconds after) {
        std::vector<std::string> all = arguments(name);
        all.insert(all.begin(), LUXEL_BINARY_DIR "/luxel");
        std::vector<char*> pointers;
        for (std::string& argument : all) pointers.push_back(argument.data());
        pointers.push_back(nullptr);
        const pid_t child = fork();
        if (child == 0) {
            dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
            execv(pointers[0], pointers.data());
            _exit(127);
        }
        std::this_thread::sleep_for(after);
        kill(child, SIGKILL);
        int status = 0;
        waitpid(child, &status, 0);
        return WIFSIGNALED(status);
    }
    TemporaryFolder folder_;
};

TEST_F(ExperimentTest, KilledAndResumedItEndsWithTheSameFigures) {
    write(small_experiment);
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(run("undisturbed").code, 0);
    const auto whole =
        std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begin);
    EXPECT_EQ(finished("undisturbed"), 6u);

    // Three kills one after the other; scripts/kill-experiment does it ten times.
    std::mt19937 random(7);
    int killed = 0;
    for (int i = 0; i < 3; ++i) killed += run_and_kill("killed", whole * int(20 + random() % 40) / 100);
    EXPECT_GE(killed, 1);
    ASSERT_EQ(run("killed").code, 0);
    EXPECT_EQ(figures("killed"), figures("undisturbed"));
    EXPECT_GT(figures("killed").size(), 1000u);
}

TEST_F(ExperimentTest, WhatIsChangedIsMeasuredAgainAndNothingElse) {
    write(small_experiment);
    ASSERT_EQ(run("a").code, 0);
    const std::string first = figures("a");
    const auto stamp = std::filesystem::last_write_time(
        *std::filesystem::directory_iterator(folder_.path() / "a" / "views"));
    ASSERT_EQ(run("a").code, 0);
    EXPECT_EQ(figures("a"), first);
    EXPECT_EQ(std::filesystem::last_write_time(
                  *std::filesystem::directory_iterator(folder_.path() / "a" / "views")),
              stamp);

    // One more view costs one view.
    write(std::string(small_experiment) + "names = [\"camera\"]\n[[scene.views]]\ncount = 1\nseed = 9\n");
    ASSERT_EQ(run("a").code, 0);
    EXPECT_EQ(finished("a"), 7u);

    // Another seed is another truth: all are measured again, and what is there is said.
    write("seed = 2\n" + std::string(small_experiment));
    const ProcessResult other = run("a");
    ASSERT_EQ(other.code, 0);
    EXPECT_NE(other.error.find("belong to other settings"), std::string::npos) << other.error;
    EXPECT_NE(figures("a"), first);

    // Back again: everything is there.
    const std::size_t all = finished("a");
    write(small_experiment);
    ASSERT_EQ(run("a").code, 0);
    EXPECT_EQ(figures("a"), first);
    EXPECT_EQ(finished("a"), all);
}

TEST_F(ExperimentTest, TruthsGoAheadAndTimeRunsOut) {
    write(small_experiment);
    const ProcessResult ahead = run("a", {"--only-truth", "--json"});
    ASSERT_EQ(ahead.code, 0) << ahead.error;
    EXPECT_EQ(nlohmann::json::parse(ahead.out).at("rendered"), 6);

    // No time at all: a report without views, and what is missing.
    const ProcessResult none = run("a", {"--minutes", "0.000001", "--json"});
    ASSERT_EQ(none.code, 0) << none.error;
    const nlohmann::json empty = nlohmann::json::parse(none.out);
    EXPECT_EQ(empty.at("missing"), 6);
    EXPECT_TRUE(empty.at("mean").empty());

    const ProcessResult all = run("a", {"--json"});
    ASSERT_EQ(all.code, 0) << all.error;
    const nlohmann::json json = nlohmann::json::parse(all.out);
    EXPECT_EQ(json.at("missing"), 0);
    for (const auto& scene : json.at("scenes"))
        for (const auto& view : scene.at("views")) EXPECT_TRUE(view.at("reference").at("cached"));
    ASSERT_EQ(json.at("summary").size(), 6u); // two techniques over two groups and all
    EXPECT_EQ(json.at("summary")[4].at("group"), "all");
    EXPECT_EQ(json.at("summary")[4].at("views"), 6);
}

constexpr const char* judged_experiment = R"toml(
size = "48x36"
frames = 1
pictures = "none"
[truth]
judge = "povray"
[[technique]]
use = "isr"
[[scene]]
source = "builtin:cornell"
)toml";

TEST_F(ExperimentTest, PovrayJudgesInPlaceOfTheReference) {
    if (!is_installed("povray")) GTEST_SKIP() << "no povray on this machine";
    write(judged_experiment);
    const ProcessResult ahead = run("a", {"--only-truth", "--json"});
    ASSERT_EQ(ahead.code, 0) << ahead.error;
    EXPECT_EQ(nlohmann::json::parse(ahead.out).at("rendered"), 1);
    const ProcessResult result = run("a", {"--json"});
    ASSERT_EQ(result.code, 0) << result.error;
    const nlohmann::json json = nlohmann::json::parse(result.out);
    EXPECT_EQ(json.at("judge"), "povray");
    const nlohmann::json& view = json.at("scenes")[0].at("views")[0];
    EXPECT_TRUE(view.at("reference").at("cached"));
    EXPECT_GT(view.at("techniques")[0].at("delta"), 0.0);

    // Another judge is another truth, but of the same light: the figures are close and not the same.
    write(std::regex_replace(std::string(judged_experiment), std::regex("judge = \"povray\""), "spp = 64"));
    const ProcessResult traced = run("a", {"--json"});
    ASSERT_EQ(traced.code, 0) << traced.error;
    const double povray = view.at("techniques")[1].at("delta"),
                 reference = nlohmann::json::parse(traced.out).at("mean")[1].at("delta");
    EXPECT_NE(povray, reference);
    EXPECT_NEAR(povray, reference, 0.02);
}

TEST_F(ExperimentTest, WithoutPovrayItsJudgmentEndsInOneSentence) {
    write(judged_experiment);
    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nowhere", 1);
    const ProcessResult result = run("a");
    setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(result.code, 3) << result.error;
    EXPECT_EQ(result.error_lines(), 1u) << result.error;
    EXPECT_NE(result.error.find("povray: not installed"), std::string::npos) << result.error;
    EXPECT_EQ(result.out, "");
}

TEST_F(ExperimentTest, AMistakeEndsItBeforeAnyWork) {
    write("[[scene]]\nsource = \"builtin:cornell\"\n[[technique]]\nuse = \"radiosty\"\n");
    const ProcessResult wrong = run("a");
    EXPECT_EQ(wrong.code, 4);
    EXPECT_EQ(wrong.error_lines(), 1u) << wrong.error;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "a"));
}

} // namespace
} // namespace luxel::testing
