// SPDX-License-Identifier: MIT
// The names after "builtin:" and the scenes they stand for.
#include "scene/procedural_builtin.h"

#include <functional>

#include "core/error.h"
#include "scene/load.h"
#include "scene/procedural.h"

namespace luxel {
namespace {

struct Entry {
    std::string name, meaning;
    std::function<Scene()> make;
};

std::vector<Entry> base_entries() {
    std::vector<Entry> entries = {
        {"cornell", "the Cornell box with its area light, all diffuse", [] { return cornell(); }},
        {"furnace", "closed room of albedo .5 that emits 1: radiance 2 everywhere",
         [] { return furnace(0.5f); }},
        {"shapes", "cube, cylinder, sphere, cone and torus under a point light",
         [] { return shapes(ShapesLight::point); }},
        {"shapes-point", "the same as shapes", [] { return shapes(ShapesLight::point); }},
        {"shapes-spot", "the same shapes under a spot light", [] { return shapes(ShapesLight::spot); }},
        {"shapes-directional", "the same shapes under a directional light",
         [] { return shapes(ShapesLight::directional); }},
        {"relief", "cobbled floor and brick wall by height maps, low sun", [] { return relief(); }},
        {"tree", "tree with 2400 leaves in six blocks, and a stone, under the sun", [] { return tree(); }},
        {"sphere-in-box", "sphere in a room of colored walls, point light", [] { return sphere_in_box(); }},
        {"glass-sphere", "glass sphere in a room, spot light", [] { return glass_sphere(); }},
        {"metal-ring", "mirroring ring on a floor, point light", [] { return metal_ring(); }},
        {"glass-metal", "metal ring, glass sphere, mirror ball and drinking glass in a room, point light",
         [] { return glass_metal(); }},
        {"mirror-box", "mirror sphere in a closed box of painted walls", [] { return mirror_box(); }},
        {"teapot-box", "mirroring pot that sees itself, in the same box", [] { return teapot_box(); }},
        {"water", "wavy water in a room, spot light, cameras below and above its surface",
         [] { return water(0.0f); }},
    };
    for (const char* albedo : {"0.0", "0.2", "0.5", "0.8", "0.9"}) {
        const float value = std::stof(albedo);
        entries.push_back({fmt::format("furnace-{}", albedo), fmt::format("furnace of albedo {}", albedo),
                           [value] { return furnace(value); }});
    }
    for (const char* seconds : {"0.25", "0.5"}) {
        const float value = std::stof(seconds);
        entries.push_back({fmt::format("water-{}", seconds), fmt::format("water {} seconds later", seconds),
                           [value] { return water(value); }});
    }
    const std::pair<const char*, BallPlace> places[] = {
        {"face", BallPlace::face}, {"edge", BallPlace::edge}, {"corner", BallPlace::corner}};
    for (const auto& [place_name, place] : places)
        for (const char* diameters : {"1", "0.2", "0.02"}) {
            const float value = std::stof(diameters);
            entries.push_back({fmt::format("ball-room-{}-{}", place_name, diameters),
                               fmt::format("ball {} diameters from a {} of a box of six colors, eight lamps",
                                           diameters, place_name),
                               [=, p = place] { return ball_room(p, value, BallLight::lamps); }});
            entries.push_back({fmt::format("glow-room-{}-{}", place_name, diameters),
                               "the same with black walls that emit their color",
                               [=, p = place] { return ball_room(p, value, BallLight::walls); }});
        }
    return entries;
}

struct Suffix {
    std::string text;
    int levels;
};
const std::vector<Suffix> subdivisions = {{"-x4", 1}, {"-x16", 2}, {"-x64", 3}};

} // namespace

Scene builtin_scene(const std::string& name) {
    // A suffix asks for the same surface in more triangles.
    std::string base = name;
    int levels = 0;
    for (const Suffix& suffix : subdivisions)
        if (name.ends_with(suffix.text))
            base = name.substr(0, name.size() - suffix.text.size()), levels = suffix.levels;

    std::string known;
    for (const Entry& entry : base_entries()) {
        if (entry.name == base) {
            Scene scene = levels > 0 ? subdivide(entry.make(), levels) : entry.make();
            scene.name = name;
            return scene;
        }
        known += (known.empty() ? "" : ", ") + entry.name;
    }
    fail(Fault::bad_input,
         "builtin:{}: no such scene; known are {}, each also with -x4, -x16 or -x64 appended", name, known);
}

std::vector<BuiltinScene> builtin_scenes() {
    std::vector<BuiltinScene> scenes;
    for (const Entry& entry : base_entries()) scenes.push_back({entry.name, entry.meaning});
    for (const Suffix& suffix : subdivisions)
        scenes.push_back(
            {"cornell" + suffix.text, fmt::format("cornell in {} times the triangles; {} may follow any name",
                                                  1 << 2 * suffix.levels, suffix.text)});
    return scenes;
}

} // namespace luxel
