// SPDX-License-Identifier: MIT
// Camera scripts: what is written is read back, with any name; slips name their line.
#include "scene/camera_file.h"

#include <fstream>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file.h"
#include "scene/procedural.h"
#include "scene/views.h"
#include "support/build_folders.h"

namespace luxel {
namespace {

class CameraFile : public ::testing::Test {
protected:
    void SetUp() override {
        const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
        file_ = std::filesystem::path(LUXEL_BINARY_DIR) / fmt::format("camera_file_{}.toml", info->name());
    }
    void TearDown() override { std::filesystem::remove(file_); }

    std::vector<Camera> read(const std::string& text) {
        write_file(file_, text);
        return load_camera_file(file_, cornell());
    }
    void expect_error(const std::string& text, const std::string& part) {
        try {
            read(text);
            ADD_FAILURE() << "no error for " << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.fault(), Fault::bad_input);
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    }

    std::filesystem::path file_;
};

void expect_near(glm::vec3 a, glm::vec3 b) { EXPECT_LT(glm::length(a - b), 1e-6f); }

TEST_F(CameraFile, ReadsBackWhatWasWritten) {
    const Scene scene = cornell();
    const RayCaster rays(scene);
    std::vector<Camera> cameras = draw_views(scene, rays, 3, 5);
    cameras[1].up = glm::normalize(glm::vec3(0.1f, 1.0f, 0.2f));
    const std::vector<Camera> read_back = read(camera_file_text(cameras, "three"));
    ASSERT_EQ(read_back.size(), cameras.size());
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        EXPECT_EQ(read_back[i].name, cameras[i].name);
        EXPECT_EQ(read_back[i].position, cameras[i].position);
        expect_near(read_back[i].forward, cameras[i].forward);
        expect_near(read_back[i].up, cameras[i].up);
        EXPECT_NEAR(read_back[i].yfov, cameras[i].yfov, 1e-6f);
        EXPECT_EQ(read_back[i].near, cameras[i].near);
        EXPECT_EQ(read_back[i].far, cameras[i].far);
    }
}

// Positions are in the coordinates of the scene's files; infinity is what is not said.
TEST_F(CameraFile, FarScenesAndParallelProjection) {
    Scene scene = cornell();
    scene.origin = {500003.5, 100, -5000000};
    Camera plan;
    plan.name = "plan";
    plan.position = {0.001f, 2.5f, 3};
    plan.half_height = 1.25f, plan.near = 0.0f, plan.far = 7.0f;
    const std::string text = camera_file_text({plan, Camera{}}, "two", scene.origin);
    EXPECT_NE(text.find("500003.501"), std::string::npos) << text;
    EXPECT_EQ(text.find("inf"), std::string::npos);
    write_file(file_, text);
    const std::vector<Camera> cameras = load_camera_file(file_, scene);
    ASSERT_EQ(cameras.size(), 2u);
    EXPECT_EQ(cameras[0].position, plan.position);
    EXPECT_EQ(cameras[0].half_height, 1.25f);
    EXPECT_EQ(cameras[0].near, 0.0f);
    EXPECT_EQ(cameras[0].far, 7.0f);
    EXPECT_EQ(cameras[1].far, Camera{}.far);
    expect_error(
        "[[camera]]\nposition = [0, 0, 0]\nforward = [0, 0, 1]\nyfov_degrees = 40\northographic_height = 2\n",
        "not both");
}

TEST_F(CameraFile, NamesAndCommentsStayWhatTheyAre) {
    Camera camera;
    camera.name = "a \"quoted\" \\ n\xc3\xa4me]";
    EXPECT_EQ(read(camera_file_text({camera}, "x"))[0].name, camera.name);

    // A line end would smuggle in a key of its own; a byte that is no UTF-8 would spoil the file.
    camera.name = "line\nfar = 3";
    const std::vector<Camera> cameras = read(camera_file_text({camera}, "evil\n[x]\xff"));
    EXPECT_EQ(cameras[0].name, "line?far = 3");
    EXPECT_EQ(cameras[0].far, camera.far);
}

TEST_F(CameraFile, SlipsAreErrors) {
    expect_error("", "there is no [[camera]]");
    expect_error("[[camera]]\nposition = [0, 0, 0]\n", "\"forward\" or \"target\"");
    expect_error("[[camera]]\nposition = [0, 0]\n", "line 2");
    expect_error("geometry = \"a.gltf\"\n[[camera]]\nposition = [0, 0, 0]\nforward = [0, 0, 1]\n",
                 "unknown key \"geometry\"");
    expect_error("[[camera]", "line 1");
}

} // namespace
} // namespace luxel
