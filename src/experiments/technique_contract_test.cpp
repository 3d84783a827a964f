// SPDX-License-Identifier: MIT
// What techniques say of themselves, for every one of them: it is true that they cannot act where they say
// so, and that a parameter has no effect where it is declared to have none.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "experiments/technique_rows.h"
#include "reference/reference.h"
#include "scene/environment.h"
#include "scene/load.h"
#include "support/gpu.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

// A frame with ambient light, and little of everything else.
FrameOptions ambient_frame() {
    FrameOptions options;
    options.shadow_size = 64, options.emitter_lights = 4, options.environment = EnvironmentMode::ambient;
    return options;
}

// A dynamic object, mirrors, glass, and a sky.
Scene everything() {
    Scene scene = load_scene("builtin:glass-metal", {.environment = "sky"});
    scene.instances.front().role = "dynamic thing";
    return scene;
}

class TechniqueContract : public testing::GpuTest {
protected:
    Image render(const Scene& scene, const FrameOptions& options, Technique* technique) {
        Renderer renderer(gpu(), scene, options);
        RenderRequest request{.camera = scene.cameras.at(0), .width = 40, .height = 30};
        if (technique) request.techniques = {technique};
        return renderer.render(request).radiance;
    }
};

TEST(Techniques, NameComponentsOfTheReferenceAndTheirNeeds) {
    for (const TechniqueInfo& info : all_techniques()) {
        const auto technique = info.make();
        EXPECT_FALSE(technique->components().empty()) << info.name;
        for (const std::string& component : technique->components())
            EXPECT_NE(std::find(component_names.begin(), component_names.end(), component),
                      component_names.end())
                << info.name << ": " << component;
        // Nothing can be lit, reflected or displaced in an empty scene.
        EXPECT_TRUE(why_idle(*technique, Scene{}, {})) << info.name;
    }
}

TEST_F(TechniqueContract, WhoCannotActChangesNoPixel) {
    const FrameOptions lights = [] {
        FrameOptions options = ambient_frame();
        options.environment = EnvironmentMode::lights, options.environment_lights = 2;
        return options;
    }();
    Scene dark = load_scene("builtin:shapes-point");
    dark.lights.clear();
    const Scene scenes[] = {load_scene("builtin:shapes-point"), load_scene("builtin:cornell"),
                            load_scene("builtin:glass-metal"), dark};
    int idle = 0;
    for (const Scene& scene : scenes) {
        const Image direct = render(scene, lights, nullptr);
        for (const TechniqueInfo& info : all_techniques()) {
            const auto technique = info.make();
            if (!why_idle(*technique, scene, lights)) continue;
            ++idle;
            EXPECT_EQ(render(scene, lights, technique.get()).data, direct.data)
                << scene.name << ": " << info.name;
        }
    }
    // Five searches of height maps, five kinds of occlusion and envmap in each scene at the least.
    EXPECT_GE(idle, 44);
}

TEST_F(TechniqueContract, WhoCanActChangesPixels) {
    const Scene scene = everything(), relief = load_scene("builtin:relief");
    const Image direct = render(scene, ambient_frame(), nullptr),
                flat = render(relief, ambient_frame(), nullptr);
    for (const TechniqueInfo& info : all_techniques()) {
        const bool surface = info.slot == Slot::surface;
        const auto technique = info.make();
        EXPECT_FALSE(why_idle(*technique, surface ? relief : scene, ambient_frame())) << info.name;
        const Image image = render(surface ? relief : scene, ambient_frame(), technique.get());
        EXPECT_NE(image.data, (surface ? flat : direct).data) << info.name;
    }
}

// Another value that is allowed.
std::string other_value(const ParameterInfo& p) {
    if (p.type == "flag") return p.value == "on" ? "off" : "on";
    if (p.type == "choice") {
        const std::string first = p.allowed.substr(0, p.allowed.find(','));
        return first != p.value ? first : p.allowed.substr(p.allowed.rfind(' ') + 1);
    }
    const double least = std::stod(p.allowed), most = std::stod(p.allowed.substr(p.allowed.find("to") + 2));
    const double value = std::stod(p.value), twice = value == 0 ? std::min(1.0, most) : 2 * value;
    return fmt::format("{}", twice <= most ? twice : std::max(value / 2, least));
}

// By its defaults, and with each of its choices and flags turned in turn.
TEST_F(TechniqueContract, AParameterThatIsSaidToHaveNoEffectHasNone) {
    const Scene scene = everything();
    int found = 0;
    for (const TechniqueInfo& info : all_techniques()) {
        const auto made = [&](std::vector<std::pair<std::string, std::string>> values) {
            return make_technique({info.name, std::move(values)});
        };
        const auto plain = info.make();
        const bool relief = info.slot == Slot::surface;
        const Scene& shown = relief ? load_scene("builtin:relief") : scene;
        const Image image = render(shown, ambient_frame(), plain.get());
        for (const ParameterInfo& p : parameters_of(*plain)) {
            if (p.acts) continue;
            EXPECT_FALSE(p.when.empty()) << info.name << ": " << p.name;
            ++found;
            const auto changed = made({{p.name, other_value(p)}});
            // To the rounding of sums whose order atomic counters decide.
            const Image other = render(shown, ambient_frame(), changed.get());
            ASSERT_EQ(other.data.size(), image.data.size());
            for (std::size_t i = 0; i < image.data.size(); ++i)
                ASSERT_NEAR(other.data[i], image.data[i], 1e-4f * (0.01f + std::abs(image.data[i])))
                    << info.name << ": " << p.name << "=" << other_value(p);
            const auto warnings = idle_parameters(*changed, info.name, {{p.name, other_value(p)}});
            ASSERT_EQ(warnings.size(), 1u) << info.name;
            EXPECT_NE(warnings[0].find(p.when), std::string::npos) << warnings[0];
        }
    }
    EXPECT_GE(found, 9);
}

TEST(TechniqueRows, WarnOfValuesThatHaveNoEffect) {
    EXPECT_TRUE(parse_use("isr:mode=thesis,spacing=3").warnings.empty());
    EXPECT_TRUE(parse_use("isr:samples=24").warnings.empty());
    const TechniqueRow row = parse_use("ssao+isr:spacing=3,k_isr=1,samples=8");
    ASSERT_EQ(row.warnings.size(), 2u);
    EXPECT_NE(row.warnings[0].find("isr: spacing=3 has no effect, as it is of mode=thesis alone"),
              std::string::npos)
        << row.warnings[0];
}

} // namespace
} // namespace luxel
