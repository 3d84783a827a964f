// SPDX-License-Identifier: MIT
// What experiment files say, and what is refused before any work.
#include "experiments/experiment_file.h"

#include <fstream>
#include <iterator>
#include <map>

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/build_folders.h"
#include "support/temporary_folder.h"

namespace luxel {
namespace {

using testing::TemporaryFolder;

Experiment load_text(const TemporaryFolder& folder, const std::string& text,
                     const std::filesystem::path& data = {}) {
    return load_experiment_file(folder.add("experiment.toml", text), data);
}

// The sentence that a file is refused with.
std::string refusal(const std::string& text) {
    const TemporaryFolder folder;
    try {
        load_text(folder, text);
    } catch (const Error& e) {
        EXPECT_EQ(e.fault(), Fault::bad_input) << e.what();
        return e.what();
    }
    return "accepted";
}

std::string documented_example() {
    std::ifstream stream(LUXEL_SOURCE_DIR "/docs/experiments.md");
    const std::string page{std::istreambuf_iterator<char>(stream), {}};
    const std::string mark = "```toml\n";
    const std::size_t begin = page.find(mark) + mark.size();
    return page.substr(begin, page.find("```", begin) - begin);
}

TEST(ExperimentFile, TheDocumentedExampleSaysWhatItsCommentsSay) {
    const TemporaryFolder folder;
    const Experiment e = load_text(folder, documented_example());
    EXPECT_EQ(e.name, "small rooms");
    EXPECT_EQ(e.uses,
              (std::vector<std::string>{"isr:mode=calibrated,samples=24", "isr:mode=calibrated,samples=80",
                                        "isr:mode=thesis,samples=24", "isr:mode=thesis,samples=80",
                                        "isr:resolution=full"}));
    EXPECT_EQ(e.truth.spp, 64);
    EXPECT_EQ(e.truth.judge, Judge::reference);
    ASSERT_EQ(e.scenes.size(), 2u);

    const SceneEntry& cornell = e.scenes[0];
    EXPECT_EQ(cornell.name, "cornell");
    ASSERT_EQ(cornell.views.size(), 1u);
    EXPECT_EQ(cornell.views[0].width, 320);
    EXPECT_EQ(cornell.views[0].choice.drawn, 0);

    const SceneEntry& shapes = e.scenes[1];
    EXPECT_EQ(shapes.name, "shapes under a sky");
    EXPECT_EQ(shapes.group, "simple");
    EXPECT_EQ(shapes.load.environment, "sky");
    EXPECT_EQ(shapes.load.environment_scale, 0.5f);
    EXPECT_EQ(shapes.frame.environment_lights, 16);
    EXPECT_EQ(shapes.frame.shadow, ShadowMode::pcf);
    ASSERT_EQ(shapes.views.size(), 2u);
    EXPECT_EQ(shapes.views[0].choice.drawn, 8);
    EXPECT_EQ(shapes.views[0].choice.seed, 3u);
    EXPECT_EQ(shapes.views[0].width, 512);
    EXPECT_EQ(shapes.views[1].choice.names, std::vector<std::string>{"camera"});
}

TEST(ExperimentFile, AMistakeIsNamedWithItsLine) {
    const std::string scene = "[[scene]]\nsource = \"builtin:cornell\"\n";
    const auto expect = [](const std::string& text, const std::string& part) {
        EXPECT_NE(refusal(text).find(part), std::string::npos) << refusal(text);
    };
    expect("sise = \"8x8\"\n" + scene, "line 1: unknown key \"sise\"; known are name, seed");
    expect(scene + "veiws = 3\n", "line 3: scene: unknown key \"veiws\"");
    expect(scene + "[[scene.views]]\ncuont = 3\n", "unknown key \"cuont\"; known are count");
    expect("[truth]\nspq = 8\n" + scene, "unknown key \"spq\"");
    expect(scene + "[[technique]]\nuse = \"isr:sample=3\"\n", "no parameter sample; known are");
    expect(scene + "[[technique]]\nuse = \"isr\"\nsweep = { sample = [3] }\n", "no parameter sample");
    expect(scene + "[[technique]]\nuse = \"isr\"\n[[technique]]\nuse = \"isr\"\n", "there already");
    expect(scene + "frame = { shadows = \"pcf\" }\n", "no parameter shadows");
    expect("[[scene]]\nsource = \"builtin:cornel\"\n", "no scene \"builtin:cornel\"; known are");
    expect("[[scene]]\nsource = \"nowhere.gltf\"\n", "nowhere.gltf\" does not exist");
    expect("[[scene]]\nsource = \"data:room.gltf\"\n", "needs --data DIR");
    expect(scene + scene, "two scenes are called \"cornell\"");
    expect(scene + "[[scene.views]]\ncameras = \"none.toml\"\n", "none.toml\" does not exist");
    expect(scene + "[[scene.views]]\nsize = \"12\"\n", "WIDTHxHEIGHT");
    expect("frames = 0\n" + scene, "line 1: \"frames\" is 0, not within");
    expect("[truth]\nao_radius = 2.0\n" + scene, "is of the component \"ao\"");
    expect("[truth]\njudge = \"mine\"\n" + scene, "line 2: truth: \"judge\" must be \"reference\" or");
    expect("[truth]\njudge = \"povray\"\ncomponent = \"full\"\n" + scene, "renders the components");
    expect("[truth]\njudge = \"povray\"\nspp = 8\n" + scene, "\"spp\" is of the judge");
    expect("name = \"empty\"\n", "there is no [[scene]]");
}

// 80 views of simple scenes and 147 of complex ones, 20 of them large.
TEST(ExperimentFile, TheThesisExperimentHasItsViews) {
    const TemporaryFolder data;
    for (const char* file :
         {"sponza_crytek/sponza_crytek.gltf", "modern_hall/modern_hall.gltf", "living_room/living_room.gltf",
          "living_room/Sky_19.exr", "dream_apartment/dream_apartment.glb", "bathroom/bathroom.gltf",
          "japanese_bridge/japanese_bridge.glb"})
        data.add(file, std::string());
    const Experiment e =
        load_experiment_file(LUXEL_SOURCE_DIR "/experiments/rohleder-2010.toml", data.path());
    std::map<std::string, int> views;
    int large = 0;
    for (const SceneEntry& scene : e.scenes)
        for (const ViewGroup& group : scene.views) {
            views[scene.group] += group.choice.drawn;
            if (group.width == 1024 && group.height == 768) large += group.choice.drawn;
        }
    EXPECT_EQ(views, (std::map<std::string, int>{{"simple", 80}, {"complex", 147}}));
    EXPECT_EQ(large, 20);
    EXPECT_EQ(e.uses, (std::vector<std::string>{"isr", "isr:mode=thesis"}));
}

TEST(ExperimentFile, PathsBeginBesideTheFileOrInTheDataFolder) {
    const TemporaryFolder folder, data;
    folder.add("room.toml", std::string("geometry = \"builtin:cornell\"\n"));
    data.add("far/hall.toml", std::string("geometry = \"builtin:cornell\"\n"));
    const Experiment e =
        load_text(folder, "[[scene]]\nsource = \"room.toml\"\n[[scene]]\nsource = \"data:far/hall.toml\"\n",
                  data.path());
    EXPECT_EQ(e.scenes[0].file, (folder.path() / "room.toml").string());
    EXPECT_EQ(e.scenes[1].file, (data.path() / "far/hall.toml").string());
    EXPECT_EQ(e.scenes[1].name, "hall");
}

} // namespace
} // namespace luxel
