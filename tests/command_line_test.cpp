// SPDX-License-Identifier: MIT
// The command line as users meet it: bad input of every kind ends in one sentence, the right exit code and no
// output.
#include <fstream>
#include <functional>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/image_io.h"
#include "support/luxel_process.h"

namespace luxel::testing {
namespace {

using Json = nlohmann::json;

// One triangle, everything inline; tests damage a copy.
Json triangle() {
    return Json::parse(R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36,
            "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]
    })");
}

struct BadScene {
    std::string name, file, content;
};
void PrintTo(const BadScene& scene, std::ostream* stream) { *stream << scene.name; }

std::string damaged(const std::function<void(Json&)>& damage) {
    Json json = triangle();
    damage(json);
    return json.dump();
}

std::vector<BadScene> bad_scenes() {
    // 0x7fc00000 is a NaN; the first position's x.
    const std::string nan_buffer =
        "data:application/octet-stream;base64,AADAfwAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    return {
        {"empty", "empty.gltf", ""},
        {"empty_binary", "empty.glb", ""},
        {"truncated_binary", "cut.glb", std::string("glTF\2\0\0\0\0\1\0\0\x40\0\0\0JSON{\"asset\"", 28)},
        {"nested_brackets", "deep.gltf", std::string(1 << 20, '[')},
        {"accessor_out_of_range", "accessor.gltf",
         damaged([](Json& j) { j["accessors"][0]["count"] = 1 << 30; })},
        {"accessor_missing", "missing.gltf",
         damaged([](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 7; })},
        {"cyclic_nodes", "cycle.gltf", damaged([](Json& j) {
             j["nodes"] = Json::parse(R"([{"mesh": 0, "children": [1]}, {"children": [0]}])");
         })},
        {"escaping_uri", "escape.gltf", damaged([](Json& j) { j["buffers"][0]["uri"] = "../secret.bin"; })},
        {"nan_vertices", "nan.gltf", damaged([&](Json& j) { j["buffers"][0]["uri"] = nan_buffer; })},
        {"zero_triangles", "none.gltf", damaged([](Json& j) { j["nodes"][0].erase("mesh"); })},
    };
}

void expect_refused(const ProcessResult& result, int code) {
    EXPECT_EQ(result.code, code) << result.error;
    EXPECT_EQ(result.error_lines(), 1u) << result.error;
    EXPECT_TRUE(result.error.starts_with("luxel: ")) << result.error;
    EXPECT_EQ(result.out, "");
}

class BadSceneTest : public ::testing::TestWithParam<BadScene> {};

TEST_P(BadSceneTest, EndsInOneSentenceAndNoOutput) {
    const TemporaryFolder folder;
    const std::string file = (folder.path() / GetParam().file).string();
    spill(file, GetParam().content);
    expect_refused(run_luxel({"info", file}), 4);

    const TemporaryFolder out;
    for (const std::vector<std::string>& command : {
             std::vector<std::string>{"evaluate", file, "-o", (out.path() / "result").string()},
             {"render", file, "-o", (out.path() / "picture.png").string()},
             {"reference", file, "-o", (out.path() / "truth.exr").string()},
         }) {
        const ProcessResult result = run_luxel(command);
        expect_refused(result, 4);
        EXPECT_NE(result.error.find(folder.path().string()), std::string::npos) << result.error;
        EXPECT_TRUE(std::filesystem::is_empty(out.path())) << command[0];
    }
}
INSTANTIATE_TEST_SUITE_P(Scenes, BadSceneTest, ::testing::ValuesIn(bad_scenes()),
                         [](const auto& test) { return test.param.name; });

TEST(CommandLine, MissingSceneIsUnreadable) { expect_refused(run_luxel({"info", "/nowhere/scene.gltf"}), 6); }

TEST(CommandLine, MissingTextureIsACountedWarningAndAnErrorWhenStrict) {
    const TemporaryFolder folder;
    const std::string file = (folder.path() / "textured.gltf").string();
    spill(file, damaged([](Json& j) {
              j["images"] = Json::parse(R"([{"uri": "gone.png"}])");
              j["textures"] = Json::parse(R"([{"source": 0}])");
              j["materials"] =
                  Json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
              j["meshes"][0]["primitives"][0]["material"] = 0;
          }));
    const ProcessResult result = run_luxel({"info", file});
    EXPECT_EQ(result.code, 0) << result.error;
    EXPECT_NE(result.error.find("luxel: warning: "), std::string::npos) << result.error;
    EXPECT_NE(result.error.find("gone.png"), std::string::npos) << result.error;
    expect_refused(run_luxel({"info", file, "--strict"}), 4);
}

TEST(CommandLine, WrongUsageIsCodeTwo) {
    const TemporaryFolder out;
    const std::string folder = (out.path() / "result").string(), picture = (out.path() / "p.png").string();
    const std::vector<std::vector<std::string>> commands = {
        {},
        {"unknown"},
        {"evaluate"},
        {"evaluate", "builtin:cornell", "--size", "0x0", "-o", folder},
        {"evaluate", "builtin:cornell", "--size", "640", "-o", folder},
        {"evaluate", "builtin:cornell", "--size", "640x99999", "-o", folder},
        {"evaluate", "builtin:cornell", "--use", "no_such_technique", "-o", folder},
        {"evaluate", "builtin:cornell", "--use", "isr:no_such_parameter=1", "-o", folder},
        {"evaluate", "builtin:cornell", "--use", "isr", "--use", "isr", "-o", folder},
        {"evaluate", "builtin:cornell", "--use", "isr+isr", "-o", folder},
        {"evaluate", "builtin:cornell", "--frame", "no_such_option=1", "-o", folder},
        {"evaluate", "builtin:cornell", "--component", "light", "-o", folder},
        {"evaluate", "builtin:cornell", "--component", "full+direct", "-o", folder},
        {"evaluate", "builtin:cornell", "--spp", "0", "-o", folder},
        {"render", "builtin:cornell", "--use", "no_such_technique", "-o", picture},
        {"reference", "builtin:cornell", "--size", "-1x5", "-o", picture},
        {"reference", "builtin:cornell", "-o", (out.path() / "truth.bmp").string()},
        {"reference", "builtin:cornell", "--view", "no such view", "-o", picture},
        {"evaluate", "builtin:cornell", "--cameras", "c.toml", "--views", "3", "-o", folder},
        {"views", "builtin:cornell", "--count", "0"},
    };
    for (const auto& command : commands) {
        SCOPED_TRACE(::testing::PrintToString(command));
        expect_refused(run_luxel(command), 2);
        EXPECT_TRUE(std::filesystem::is_empty(out.path()));
    }
}

TEST(CommandLine, SizesThatDoNotFitAreCodeFive) {
    const TemporaryFolder out;
    const std::string all = "16384x16384", picture = (out.path() / "p.exr").string();
    std::vector<std::string> command = {"reference", "builtin:cornell", "--size", all, "-o", picture};
    // 170 GB and more for the six of them.
    for (const char* c : {"direct", "diffuse1", "diffuse", "specular", "full", "ao"})
        command.insert(command.end(), {"--component", c});
    expect_refused(run_luxel(command), 5);
    EXPECT_TRUE(std::filesystem::is_empty(out.path()));
}

TEST(CommandLine, UnknownNamesListTheKnownOnes) {
    const TemporaryFolder out;
    const std::string picture = (out.path() / "p.png").string();
    const std::vector<std::pair<std::vector<std::string>, std::string>> commands = {
        {{"evaluat"}, "evaluate"},
        {{"render", "builtin:cornell", "--use", "none", "-o", picture}, "known"},
        {{"render", "builtin:cornell", "--frame", "none=1", "-o", picture}, "shadow_size"},
        {{"render", "builtin:shapes-point", "--image", "none", "-o", picture}, "depth"},
        {{"reference", "builtin:cornell", "--component", "none", "-o", picture}, "diffuse1"},
        {{"info", "builtin:none"}, "cornell"},
    };
    for (const auto& [command, known] : commands)
        EXPECT_NE(run_luxel(command).error.find(known), std::string::npos)
            << ::testing::PrintToString(command);
}

TEST(CommandLine, MistypedNamesAreAnsweredByWhatIsMeant) {
    const TemporaryFolder out;
    const std::string picture = (out.path() / "p.png").string();
    const std::vector<std::pair<std::vector<std::string>, std::string>> commands = {
        {{"evalaute"}, "evaluate"},
        {{"--quiet", "--threads", "2", "redner"}, "render"},
        {{"render", "--ues", "isr"}, "--use"},
        {{"info", "builtin:cornell", "--jsn"}, "--json"},
        {{"info", "builtin:cornel"}, "cornell"},
        {{"render", "builtin:cornell", "--use", "irs", "-o", picture}, "isr"},
        {{"render", "builtin:cornell", "--use", "isr:samlpes=8", "-o", picture}, "samples"},
        {{"render", "builtin:cornell", "--use", "isr:mode=calibarted", "-o", picture}, "calibrated"},
        {{"render", "builtin:cornell", "--frame", "shadow_sise=8", "-o", picture}, "shadow_size"},
        {{"render", "builtin:cornell", "--view", "kamera", "-o", picture}, "camera"},
        {{"render", "builtin:shapes-point", "--image", "dept", "-o", picture}, "depth"},
        {{"reference", "builtin:cornell", "--component", "diffus1", "-o", picture}, "diffuse1"},
    };
    for (const auto& [command, meant] : commands) {
        const ProcessResult result = run_luxel(command);
        EXPECT_NE(result.code, 0);
        EXPECT_NE(result.error.find("did you mean " + meant + "?"), std::string::npos)
            << ::testing::PrintToString(command) << result.error;
    }
}

// Beneath a regular file nobody can make anything, not even root.
TEST(CommandLine, UnwritableOutputIsCodeSixBeforeAnyWork) {
    const TemporaryFolder folder;
    spill(folder.path() / "file", "");
    expect_refused(run_luxel({"evaluate", "builtin:cornell", "-o", (folder.path() / "file/result").string()}),
                   6);
    expect_refused(run_luxel({"evaluate", "builtin:cornell", "-o", (folder.path() / "file").string()}), 6);
    expect_refused(run_luxel({"render", "builtin:cornell", "-o", (folder.path() / "file/p.png").string()}),
                   6);
    expect_refused(run_luxel({"reference", "builtin:cornell", "-o", (folder.path() / "none/p.exr").string()}),
                   6);
    EXPECT_EQ(slurp(folder.path() / "file"), "");
}

TEST(CommandLine, HelpAndVersionSucceed) {
    EXPECT_EQ(run_luxel({"--version"}).out, "luxel " LUXEL_VERSION "\n");
    for (const char* name : {"evaluate", "render", "reference", "diff", "techniques", "scenes", "info",
                             "views", "export", "reproduce", "devices", "experiment"}) {
        const ProcessResult result = run_luxel({name, "--help"});
        EXPECT_EQ(result.code, 0);
        EXPECT_NE(result.out.find("Example"), std::string::npos) << name;
        for (const char* option : {"--json", "--quiet", "--strict", "--data", "--threads", "--environment "})
            EXPECT_NE(result.out.find(option), std::string::npos) << name << ' ' << option;
        EXPECT_EQ(result.error, "");
    }
}

TEST(CommandLine, InfoTechniquesAndDevicesSpeakJson) {
    const Json info = Json::parse(run_luxel({"info", "builtin:cornell", "--json"}).out);
    EXPECT_GE(info.at("triangles"), 30);
    EXPECT_FALSE(info.at("cameras").empty());
    const TemporaryFolder folder;
    const std::string scene = (folder.path() / "boxes.toml").string();
    std::ofstream(scene) << "geometry = \"builtin:cornell\"\n[[object]]\nname = \"*box\"\nrole = \"boxes\"\n"
                            "impostor = \"nailboard\"\n";
    const Json impostors = Json::parse(run_luxel({"info", scene, "--json"}).out).at("impostors");
    EXPECT_EQ(impostors,
              Json::parse(
                  R"([{"name": "boxes", "kind": "nailboard", "size": 256, "error": 1.0, "instances": 2}])"));
    EXPECT_TRUE(info.at("impostors").empty());
    const Json techniques = Json::parse(run_luxel({"techniques", "--json"}).out);
    for (const Json& technique : techniques.at("techniques"))
        for (const char* key : {"name", "slot", "summary", "parameters"})
            EXPECT_TRUE(technique.contains(key)) << key;
    EXPECT_FALSE(techniques.at("frame").empty());
    EXPECT_TRUE(Json::parse(run_luxel({"devices", "--json"}).out).at("devices").is_array());
    for (const Json& entry : Json::parse(run_luxel({"scenes", "--json"}).out).at("scenes"))
        EXPECT_TRUE(entry.at("source").get<std::string>().starts_with("builtin:"));
}

TEST(CommandLine, DrawnViewsServeAsCameras) {
    const TemporaryFolder out;
    const std::string script = (out.path() / "views.toml").string(),
                      picture = (out.path() / "truth.exr").string();
    const std::vector<std::string> draw = {"views", "builtin:cornell", "--count", "3", "--seed", "7"};
    std::vector<std::string> draw_to_file = draw;
    draw_to_file.insert(draw_to_file.end(), {"-o", script});
    EXPECT_EQ(run_luxel(draw_to_file).code, 0);
    EXPECT_EQ(run_luxel(draw).out, slurp(script));

    // The last of them by number; there is no further one.
    std::vector<std::string> look = {
        "reference", "builtin:cornell", "--cameras", script, "--size",  "8x6",   "--spp", "1",
        "-o",        picture,           "--view",    "2",    "--quiet", "--json"};
    const ProcessResult result = run_luxel(look);
    ASSERT_EQ(result.code, 0) << result.error;
    EXPECT_EQ(Json::parse(result.out).at("view"), "seed 7 view 3");
    look[11] = "3";
    EXPECT_EQ(run_luxel(look).code, 2);
}

// Every cell of a column begins where the first one does: a column's text is never cut by its neighbor's.
TEST(CommandLine, ListsAreColumns) {
    std::istringstream lines(run_luxel({"scenes"}).out);
    std::string line;
    std::size_t column = 0, count = 0;
    while (std::getline(lines, line)) {
        const std::size_t gap = line.find("  "), text = line.find_first_not_of(' ', gap);
        ASSERT_NE(text, std::string::npos) << line;
        if (count++ == 0) column = text;
        EXPECT_EQ(text, column) << line;
    }
    EXPECT_GT(count, 20u);

    std::istringstream parameters(run_luxel({"techniques"}).out);
    std::getline(parameters, line);
    const std::size_t value = line.find("default"), allowed = line.find("allowed"),
                      meaning = line.find("meaning");
    std::size_t checked = 0;
    while (std::getline(parameters, line)) {
        const bool told = line.starts_with("  needs ") || line.starts_with("  computes ");
        if (told || !line.starts_with("  ")) continue; // a technique's heading
        ++checked;
        for (const std::size_t start : {value, allowed, meaning}) {
            EXPECT_EQ(line[start - 1], ' ') << line;
            EXPECT_NE(line[start], ' ') << line;
        }
    }
    EXPECT_GT(checked, 50u);
}

TEST(CommandLine, SeveralImagesAreLayersOfOneFile) {
    const TemporaryFolder out;
    const std::string file = (out.path() / "layers.exr").string();
    std::vector<std::string> command = {"render",  "builtin:shapes-point",
                                        "--size",  "32x24",
                                        "--image", "depth",
                                        "--image", "normal",
                                        "-o",      file,
                                        "--quiet"};
    const ProcessResult result = run_luxel(command);
    ASSERT_EQ(result.code, 0) << result.error;
    const Layers layers = read_exr(file).layers;
    ASSERT_TRUE(layers.count("depth") && layers.count("normal") && layers.count("mask"));
    EXPECT_EQ(layers.at("depth").channels, 1);
    EXPECT_EQ(layers.at("normal").channels, 4);

    // A PNG holds one, and an EXR's layers are of one size.
    command[9] = (out.path() / "layers.png").string();
    expect_refused(run_luxel(command), 2);
    command[9] = file;
    command[7] = "isr patches";
    command.insert(command.end(), {"--use", "isr"});
    expect_refused(run_luxel(command), 2);
}

TEST(CommandLine, RenderUnrollsCubesAndShowsTwoChannels) {
    const TemporaryFolder out;
    const std::string file = (out.path() / "image.exr").string();
    const auto render = [&](const std::string& use, const std::string& image) {
        const ProcessResult result = run_luxel({"render", "builtin:glass-sphere", "--size", "32x24", "--use",
                                                use, "--image", image, "-o", file, "--quiet"});
        EXPECT_EQ(result.code, 0) << result.error;
        const Layers layers = read_exr(file).layers;
        return layers.count("") ? layers.at("") : Image();
    };
    const Image cube = render("distance_map:size=64", "distance_map 0 cube radiance");
    const int face = render("distance_map:size=64", "distance_map 0 cube radiance:layer=0").width;
    EXPECT_EQ(face, 64);
    EXPECT_GT(cube.width, 0);
    EXPECT_EQ(cube.width % (4 * face), 0);
    EXPECT_EQ(cube.height % (3 * face), 0);
    const Image ranges = render("distance_map:size=64", "distance_map 0 cube min max:layer=1");
    EXPECT_EQ(ranges.channels, 3);
    EXPECT_EQ(ranges.width,
              render("distance_map:size=64", "distance_map 0 cube min max:layer=1,mip=1").width * 2);
}

TEST(CommandLine, RenderWritesImagesThatAreSmallerThanTheFrame) {
    const TemporaryFolder out;
    for (const char* name : {"patches.png", "patches.exr"}) {
        const std::string file = (out.path() / name).string();
        const ProcessResult result = run_luxel({"render", "builtin:shapes-point", "--size", "32x24", "--use",
                                                "isr", "--image", "isr patches", "-o", file});
        ASSERT_EQ(result.code, 0) << result.error;
        EXPECT_GT(slurp(file).size(), 100u);
    }
}

} // namespace
} // namespace luxel::testing
