// SPDX-License-Identifier: MIT
// Small scenes rebuilt from public bug reports, each with its right value, through the reference and the
// frame. They are skipped where the data is not there; folders' own tests have the same kinds with inputs
// that they make.
#include <cmath>

#include <gtest/gtest.h>

#include "core/image_io.h"
#include "reference/reference.h"
#include "scene/height_field.h"
#include "scene/load.h"
#include "support/data.h"
#include "support/gpu.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

using testing::data_file;

struct Look {
    std::string component = "direct";
    int side = 16, spp = 16;
    std::string environment; // beside the scene
    FrameOptions frame = {.emitter_lights = 512};
};

Scene scene_of(const std::filesystem::path& file, const Look& look) {
    LoadOptions options;
    if (!look.environment.empty()) options.environment = (file.parent_path() / look.environment).string();
    return load_scene(file.string(), options);
}

Image reference_of(const std::filesystem::path& file, const Look& look = {}) {
    const Scene scene = scene_of(file, look);
    ReferenceRequest request{.components = {look.component},
                             .width = look.side,
                             .height = look.side,
                             .camera = scene.cameras.at(0)};
    request.settings.spp = look.spp;
    const Scene displaced = with_height_fields(scene);
    return render_reference(RayCaster(displaced), request).mean.at(look.component);
}

Image frame_of(const std::filesystem::path& file, const Look& look = {}) {
    const Scene scene = scene_of(file, look);
    gpu::Gpu gpu;
    return Renderer(gpu, scene, look.frame)
        .render({.camera = scene.cameras.at(0), .width = look.side, .height = look.side})
        .radiance;
}

glm::vec3 middle(const Image& image) { return image.rgb(image.width / 2, image.height / 2); }

glm::vec3 mean(const Image& image) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) sum += glm::dvec3(image.rgb(x, y));
    return glm::vec3(sum / double(image.pixels()));
}

// Mean absolute difference over the mean of `right`.
double difference(const Image& image, const Image& right) {
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < right.data.size(); ++i)
        sum += std::abs(double(image.data[i]) - double(right.data[i])),
            all += std::abs(double(right.data[i]));
    return sum / all;
}

// `share` of `right`.
void expect_color(glm::vec3 color, glm::vec3 right, float share, const std::string& what) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(color[c], right[c], std::max(share * right[c], 1e-4f)) << what << ", channel " << c;
}

#define REPORT(variable, relative) LUXEL_DATA_OR_SKIP(variable, std::string("reports/") + relative)

TEST(Reports, CamerasWithoutFarPlaneSeeEverything) {
    REPORT(folder, "01-camera-no-zfar");
    const Look look{.side = 32, .spp = 4};
    for (const auto& [file, right] :
         {std::pair("board_1500m_no_zfar.gltf", 1.0f), std::pair("board_1500m_zfar_1000.gltf", 0.0f)}) {
        expect_color(middle(reference_of(folder / file, look)), glm::vec3(right), 0.01f, file);
        expect_color(middle(frame_of(folder / file, look)), glm::vec3(right), 0.01f, file);
    }
}

TEST(Reports, MaskedEmittersSendWhatTheyShow) {
    REPORT(folder, "02-masked-emitter");
    for (const char* file : {"truth_half_panel.gltf", "masked_factor.gltf", "masked_texture.gltf"}) {
        // The README's figure is of the middle; the mean was integrated by itself over camera and panel.
        const Image reference = reference_of(folder / file, {.side = 17, .spp = 2048});
        expect_color(middle(reference), glm::vec3(0.1411f), 0.02f, file);
        expect_color(mean(reference), glm::vec3(0.13724f), 0.005f, file);
        expect_color(mean(frame_of(folder / file, {.side = 17})), glm::vec3(0.13724f), 0.02f, file);
    }
}

TEST(Reports, DataWindowsLieInTheirDisplayWindow) {
    REPORT(folder, "03-exr-data-window");
    EXPECT_EQ(read_image(folder / "trimmed.exr").data, read_image(folder / "whole.exr").data);
    for (const char* sky : {"sky_trimmed.exr", "sky_whole.exr"})
        expect_color(mean(reference_of(folder / "floor.gltf", {.spp = 256, .environment = sky})),
                     glm::vec3(0.305f), 0.01f, sky);
}

TEST(Reports, RoofsOfSixteenBitsAreFlat) {
    REPORT(folder, "04-png16-height");
    for (const char* file : {"roof8.toml", "roof16.toml"}) {
        const Image image = reference_of(folder / file, {.side = 32});
        for (int y = 4; y < 28; ++y)
            for (int x : {6, 10, 22, 26}) {
                const float value = image.rgb(x, y).g;
                EXPECT_LT(std::min(std::abs(value / 0.0591f - 1.0f), std::abs(value / 0.0497f - 1.0f)), 0.01f)
                    << file << " at " << x << ", " << y << ": " << value;
            }
    }
}

TEST(Reports, MorphedAndSkinnedMeshesStandAtRest) {
    REPORT(morph, "05-morph-weights");
    REPORT(skin, "06-skinned-node");
    const Look look{.side = 64, .spp = 4};
    const Image moved = reference_of(morph / "mesh_weight_1.gltf", look);
    const Image still = reference_of(morph / "no_weights.gltf", look);
    // The board's middle is at x = +1 or -1, 5 m away, in a view of .8 rad.
    const int offset = int(std::lround(32.0 / (5.0 * std::tan(0.4))));
    EXPECT_GT(moved.rgb(32 + offset, 32).g, 0.0f);
    EXPECT_EQ(moved.rgb(32 - offset, 32).g, 0.0f);
    EXPECT_GT(still.rgb(32 - offset, 32).g, 0.0f);
    EXPECT_LT(difference(reference_of(skin / "armature_of_a_hundredth.gltf", look),
                         reference_of(skin / "plain.gltf", look)),
              1e-4);
}

TEST(Reports, DollHousesAreOpenFromBehind) {
    REPORT(folder, "07-single-sided");
    const Look look{.side = 17};
    expect_color(middle(reference_of(folder / "doll_house.gltf", look)), glm::vec3(1.0f), 0.01f, "reference");
    expect_color(middle(frame_of(folder / "doll_house.gltf", look)), glm::vec3(1.0f), 0.01f, "frame");
    EXPECT_LT(middle(reference_of(folder / "doll_house_double.gltf", look)).g, 0.5f);
    EXPECT_LT(middle(frame_of(folder / "doll_house_double.gltf", look)).g, 0.5f);
}

TEST(Reports, MirroredCoordinatesKeepTheirTangents) {
    REPORT(folder, "08-mirrored-uv");
    for (const char* file : {"shared.gltf", "split.gltf", "split_with_tangents.gltf"})
        for (const Image& image : {reference_of(folder / file), frame_of(folder / file)})
            for (int x : {1, 3, 6, 9, 12, 14})
                EXPECT_NEAR(image.rgb(x, 8).g, x < 8 ? 0.0796f : 0.1592f, 0.001f) << file << " at " << x;
}

TEST(Reports, PlacesFarFromTheOriginKeepTheirShadows) {
    REPORT(folder, "09-far-from-origin");
    Look look{.side = 64};
    look.frame.shadow = ShadowMode::hard;
    EXPECT_LT(
        difference(reference_of(folder / "at_utm.gltf", look), reference_of(folder / "at_origin.gltf", look)),
        0.01);
    EXPECT_LT(difference(frame_of(folder / "at_utm.gltf", look), frame_of(folder / "at_origin.gltf", look)),
              0.01);
}

TEST(Reports, NarrowSpotsHaveTheirIntensityOnTheAxis) {
    REPORT(folder, "10-narrow-spot");
    for (const char* file : {"cone_0_5.gltf", "cone_1.gltf", "cone_5.gltf"}) {
        expect_color(middle(reference_of(folder / file)), glm::vec3(0.1592f), 0.01f, file);
        expect_color(middle(frame_of(folder / file)), glm::vec3(0.1592f), 0.01f, file);
    }
}

TEST(Reports, MaterialLibrariesMayBeMirrors) {
    REPORT(folder, "11-mtl-pbr");
    expect_color(mean(reference_of(folder / "factors.toml", {.component = "full", .spp = 256})),
                 glm::vec3(0.81f), 0.01f, "factors.toml");
}

TEST(Reports, BlendedFilmsCoverTheirShare) {
    REPORT(folder, "12-blend-coverage");
    expect_color(mean(reference_of(folder / "film_30.gltf", {.spp = 256})), glm::vec3(0.7f), 0.01f,
                 "reference");
    expect_color(middle(frame_of(folder / "film_30.gltf")), glm::vec3(0.7f), 0.01f, "frame");
}

TEST(Reports, SolidsAbsorbByDistance) {
    REPORT(folder, "13-volume-absorption");
    const Look look{.component = "full", .spp = 64};
    expect_color(middle(reference_of(folder / "absorbing_1m.gltf", look)), {0.1f, 0.5f, 0.9f}, 0.01f,
                 "absorbing");
    expect_color(middle(reference_of(folder / "clear.gltf", look)), glm::vec3(1.0f), 0.01f, "clear");
}

TEST(Reports, InstancedMeshesAreAllThere) {
    REPORT(folder, "14-gpu-instancing");
    EXPECT_EQ(load_scene((folder / "used.gltf").string()).triangles(), 8u);
}

TEST(Reports, JpegsThatDecodeAreShown) {
    REPORT(folder, "15-jpeg-stray");
    for (const char* file : {"plain.gltf", "no_eoi.gltf", "cmyk.gltf"})
        expect_color(middle(reference_of(folder / file, {.side = 8, .spp = 4})), {0.578f, 0.045f, 0.045f},
                     0.04f, file);
}

TEST(Reports, ALampOfAFewTexelsShines) {
    REPORT(folder, "17-textured-emitter");
    for (const char* file : {"one_lamp_quads.gltf", "one_lamp_texture.gltf"}) {
        expect_color(mean(reference_of(folder / file, {.spp = 512})), glm::vec3(0.0803f), 0.01f, file);
        expect_color(mean(frame_of(folder / file)), glm::vec3(0.0803f), 0.01f, file);
    }
    EXPECT_LT(difference(reference_of(folder / "shell_texture.gltf", {.spp = 256}),
                         reference_of(folder / "shell_factor.gltf", {.spp = 256})),
              0.02);
}

TEST(Reports, ChannelsAreFoundUnderOtherNames) {
    REPORT(folder, "19-exr-channel-names");
    for (const char* file : {"dotted.exr", "extra.exr"})
        EXPECT_EQ(read_image(folder / file).data, read_image(folder / "rgb.exr").data) << file;
}

TEST(Reports, ScenesOfAnyScaleAreTheSame) {
    REPORT(folder, "22-tiny-scene");
    const Look look{.side = 64, .spp = 4};
    const Image right = reference_of(folder / "metre.gltf", look),
                frame = frame_of(folder / "metre.gltf", look);
    for (const char* file : {"millimetre.gltf", "kilometre.gltf"}) {
        EXPECT_LT(difference(reference_of(folder / file, look), right), 0.005) << file;
        EXPECT_LT(difference(frame_of(folder / file, look), frame), 0.005) << file;
    }
}

TEST(Reports, ASunInOneTexelIsFound) {
    REPORT(folder, "23-sun-in-hdri");
    const Look look{.spp = 64, .environment = "sun.hdr"};
    expect_color(mean(reference_of(folder / "floor.gltf", look)), glm::vec3(15.291f), 0.01f, "reference");
    expect_color(mean(frame_of(folder / "floor.gltf", look)), glm::vec3(15.291f), 0.01f, "frame");
}

TEST(Reports, TextureNamesAreResolvedBeforeTheyAreJudged) {
    REPORT(folder, "24-texture-uris");
    for (const char* file : {"dotdot_inside.gltf", "space_raw.gltf"}) {
        const Scene scene = load_scene((folder / "model" / file).string());
        ASSERT_FALSE(scene.textures.empty()) << file;
        for (const std::string& warning : scene.warnings)
            EXPECT_EQ(warning.find("replaced"), std::string::npos) << warning;
    }
}

TEST(Reports, SmoothLowPolyChromeHasNoBlackPixels) {
    REPORT(folder, "25-smooth-low-poly");
    for (const char* file : {"chrome_12x6.gltf", "chrome_48x24.gltf"}) {
        const Image image = reference_of(
            folder / file, {.component = "full", .side = 64, .spp = 64, .environment = "white.exr"});
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                EXPECT_NEAR(image.rgb(x, y).g, 1.0f, 0.01f) << file << " at " << x << ", " << y;
    }
}

TEST(Reports, SingleBadValuesAreRepaired) {
    REPORT(folder, "30-nan-attribute");
    const Image right = reference_of(folder / "sound.gltf");
    for (const char* file : {"nan_tangent.gltf", "zero_normal.gltf"}) {
        EXPECT_FALSE(load_scene((folder / file).string()).warnings.empty()) << file;
        EXPECT_LT(difference(reference_of(folder / file), right), 0.01) << file;
    }
}

TEST(Reports, MaskedLeavesKeepTheirCoverageFarAway) {
    REPORT(folder, "31-mask-far-away");
    const Look look{.side = 24, .spp = 256};
    expect_color(mean(reference_of(folder / "quarter_far.gltf", look)), glm::vec3(0.223f), 0.03f,
                 "reference");
    expect_color(mean(frame_of(folder / "quarter_far.gltf", look)), glm::vec3(0.223f), 0.1f, "frame");
}

TEST(Reports, FlattenedObjectsStay) {
    REPORT(folder, "33-flattened-scale");
    for (const char* file : {"flat_z.gltf", "thin_z.gltf"}) {
        expect_color(middle(reference_of(folder / file)), glm::vec3(1.0f), 0.01f, file);
        expect_color(middle(frame_of(folder / file)), glm::vec3(1.0f), 0.01f, file);
    }
}

TEST(Reports, CubeCrossesAreUnfoldedOrNamed) {
    REPORT(folder, "35-odd-environments");
    expect_color(mean(reference_of(folder / "floor.gltf", {.spp = 64, .environment = "plain.exr"})),
                 glm::vec3(0.5f), 0.01f, "plain");
    expect_color(mean(reference_of(folder / "floor.gltf", {.spp = 64, .environment = "cross_4x3.exr"})),
                 glm::vec3(0.5f), 0.01f, "cross");
}

} // namespace
} // namespace luxel
