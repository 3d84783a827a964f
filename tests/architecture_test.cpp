// SPDX-License-Identifier: MIT
// The rules of docs/architecture.md that a compiler does not check: who includes whom, file length, license
// line.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/build_folders.h"

namespace luxel {
namespace {

namespace fs = std::filesystem;
const fs::path root = LUXEL_SOURCE_DIR;

// The luxel folders that each folder of src/ may include, besides itself; apps may include all.
const std::map<std::string, std::set<std::string>> arrows = {
    {"shared", {}},
    {"core", {"shared"}},
    {"scene", {"core", "shared"}},
    {"reference", {"scene", "core", "shared"}},
    {"bake", {"scene", "core", "shared"}},
    {"gpu", {"core", "shared"}},
    {"techniques", {"gpu", "scene", "bake", "core", "shared"}},
    {"experiments", {"techniques", "reference", "bake", "gpu", "scene", "core", "shared"}},
};
// Folders of src/techniques that every technique may include.
const std::set<std::string> common_to_techniques = {"frame", "common"};
constexpr std::size_t longest_file = 400;

std::vector<fs::path> sources(const fs::path& folder) {
    const std::set<std::string> endings = {".h", ".cpp", ".comp", ".vert", ".frag", ".glsl"};
    std::vector<fs::path> files;
    if (!fs::exists(folder)) return files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && endings.count(entry.path().extension().string()))
            files.push_back(entry.path());
    return files;
}

std::vector<std::string> lines_of(const fs::path& file) {
    std::ifstream stream(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::vector<std::string> parts_of(const fs::path& path) {
    std::vector<std::string> parts;
    for (const fs::path& part : path) parts.push_back(part.string());
    return parts;
}

// Why `file` (relative to src) may not include `included` (relative to src); empty when it may.
std::string objection(const fs::path& file, const fs::path& included) {
    const std::vector<std::string> from = parts_of(file), to = parts_of(included);
    if (!arrows.count(from[0])) return "folder " + from[0] + " has no arrows";
    if (from[0] != to[0]) return arrows.at(from[0]).count(to[0]) ? "" : from[0] + " may not see " + to[0];
    if (from[0] != "techniques" || to.size() < 3) return "";
    // The list of techniques includes them all.
    if (from.size() < 3 || from[1] == to[1] || common_to_techniques.count(to[1])) return "";
    return from[1] + " may not see " + to[1];
}

TEST(Architecture, IncludesFollowTheArrows) {
    const std::regex include("^\\s*#\\s*include\\s*\"([^\"]+)\"");
    std::size_t seen = 0;
    for (const fs::path& file : sources(root / "src")) {
        const fs::path relative = fs::relative(file, root / "src");
        for (const std::string& line : lines_of(file)) {
            std::smatch match;
            if (!std::regex_search(line, match, include)) continue;
            const fs::path included = match[1].str();
            if (parts_of(included)[0] == "support") { // helpers of tests and benchmarks
                const std::string name = file.filename().string();
                EXPECT_TRUE(name.find("test") != name.npos || name.find("_benchmark") != name.npos)
                    << relative << ": " << line;
                continue;
            }
            EXPECT_TRUE(fs::exists(root / "src" / included))
                << relative << ": " << line << ": includes are written from src/";
            EXPECT_EQ(objection(relative, included), "") << relative << ": " << line;
            ++seen;
        }
    }
    EXPECT_GT(seen, 50u);
}

TEST(Architecture, TheRuleRefusesWhatItShould) {
    EXPECT_NE(objection("reference/path.cpp", "gpu/gpu.h"), "");
    EXPECT_NE(objection("core/image.cpp", "scene/scene.h"), "");
    EXPECT_NE(objection("gpu/gpu.cpp", "scene/scene.h"), "");
    EXPECT_NE(objection("techniques/isr/isr.cpp", "reference/reference.h"), "");
    EXPECT_NE(objection("techniques/isr/isr.cpp", "techniques/ssao/ssao.h"), "");
    EXPECT_NE(objection("techniques/frame/frame.cpp", "techniques/isr/isr.h"), "");
    EXPECT_EQ(objection("techniques/isr/isr.cpp", "techniques/frame/frame.h"), "");
    EXPECT_EQ(objection("techniques/isr/isr.cpp", "techniques/technique.h"), "");
    EXPECT_EQ(objection("techniques/techniques.cpp", "techniques/isr/isr.h"), "");
}

TEST(Architecture, OnlyRaycastingKnowsEmbreeAndOnlyTheGpuFolderCallsVulkan) {
    for (const fs::path& file : sources(root / "src")) {
        const std::string relative = fs::relative(file, root / "src").string();
        const bool benchmark = relative.ends_with("_benchmark.cpp");
        for (const std::string& line : lines_of(file)) {
            if (line.find("#include <embree") != line.npos) {
                EXPECT_TRUE(relative.starts_with("scene/raycast") || benchmark) << relative;
            }
            if (line.find("#include <vulkan") != line.npos) {
                EXPECT_TRUE(relative.starts_with("gpu/")) << relative;
            }
        }
    }
}

TEST(Architecture, FilesAreShortAndSayTheirLicense) {
    for (const char* folder : {"src", "apps", "tests"})
        for (const fs::path& file : sources(root / folder)) {
            const std::vector<std::string> lines = lines_of(file);
            const std::string name = fs::relative(file, root).string();
            ASSERT_FALSE(lines.empty()) << name;
            EXPECT_LE(lines.size(), longest_file) << name;
            // GLSL has to begin with #version and what it requires.
            std::size_t first = 0;
            while (first + 1 < lines.size() && lines[first].starts_with("#version")) ++first;
            while (first + 1 < lines.size() && lines[first].starts_with("#extension")) ++first;
            EXPECT_EQ(lines[first], "// SPDX-License-Identifier: MIT") << name;
        }
}

} // namespace
} // namespace luxel
