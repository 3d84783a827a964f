// SPDX-License-Identifier: MIT
// The names after "builtin:" and the scenes they stand for.
#include "scene/procedural_builtin.h"

#include <charconv>
#include <functional>
#include <optional>

#include "core/closest.h"
#include "core/error.h"
#include "scene/load.h"
#include "scene/procedural.h"
#include "scene/procedural_interiors.h"

namespace luxel {
namespace {

struct Entry {
    std::string name, meaning;
    std::function<Scene()> make;
    std::function<Scene(float)> at_seconds = {}; // of what moves
};

Entry moving(const char* name, const char* meaning, Scene (*make)(float)) {
    return {name, fmt::format("{}; {}-1.5: 1.5 seconds later, and so on", meaning, name),
            [make] { return make(0.0f); }, make};
}

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
        {"color-room", "closed box of six colors, eight lamps, to place things in",
         [] { return color_room(BallLight::lamps); }},
        {"mirror-box", "mirror sphere in a closed box of painted walls", [] { return mirror_box(); }},
        {"teapot-box", "mirroring pot that sees itself, in the same box", [] { return teapot_box(); }},
        {"ring", "gold ring in a room, spot light, 202 triangles", [] { return ring(); }},
        {"occluded-ring", "ring on a platform behind four walls, spot light, 214 triangles",
         [] { return occluded_ring(); }},
        {"bunnies-ring", "three solids with ears and a ring, spot light, 208 622 triangles",
         [] { return bunnies_ring(); }},
        {"lamp-room", "bulb in an opaque shade, in a room", lamp_room},
        {"classroom", "desks and chairs beside open windows, sun and sky", classroom},
        {"glazed-room", "room behind panes of thin glass, sun and sky", glazed_room},
        {"torus-in-glass", "diffuse torus in a block of glass, spot light", torus_in_glass},
        moving("water", "wavy water in a room, spot light, cameras below and above its surface", water),
        moving("water-room", "shallow water in a room, spot light, 1932 triangles", water_room),
        moving("pool", "basin of water to place in other scenes", pool),
    };
    for (const char* albedo : {"0.0", "0.2", "0.5", "0.8", "0.9"}) {
        const float value = std::stof(albedo);
        entries.push_back({fmt::format("furnace-{}", albedo), fmt::format("furnace of albedo {}", albedo),
                           [value] { return furnace(value); }});
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

// The seconds in "NAME-SECONDS", below a day.
std::optional<float> seconds_after(const std::string& name, const std::string& text) {
    if (!text.starts_with(name + "-")) return std::nullopt;
    const char *first = text.data() + name.size() + 1, *last = text.data() + text.size();
    float value = 0.0f;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error != std::errc{} || end != last || !(value >= 0.0f && value <= 86400.0f)) return std::nullopt;
    return value;
}

// A scene's name taken apart: what to make, and how often to subdivide it.
struct Request {
    std::function<Scene()> make; // empty: unknown
    int levels = 0;
};

Request parse(const std::string& name, const std::vector<Entry>& entries) {
    // A suffix asks for the same surface in more triangles.
    Request request;
    std::string base = name;
    for (const Suffix& suffix : subdivisions)
        if (name.ends_with(suffix.text))
            base = name.substr(0, name.size() - suffix.text.size()), request.levels = suffix.levels;

    for (const Entry& entry : entries) {
        const auto seconds = entry.at_seconds ? seconds_after(entry.name, base) : std::nullopt;
        if (entry.name == base) request.make = entry.make;
        if (seconds) request.make = [make = entry.at_seconds, s = *seconds] { return make(s); };
    }
    return request;
}

} // namespace

Scene builtin_scene(const std::string& name) {
    const std::vector<Entry> entries = base_entries();
    const Request request = parse(name, entries);
    if (request.make) {
        Scene scene = request.make();
        if (request.levels > 0) scene = subdivide(scene, request.levels);
        scene.name = name;
        return scene;
    }
    std::vector<std::string> known;
    for (const Entry& entry : entries) known.push_back(entry.name);
    fail(Fault::bad_input, "builtin:{}: no such scene; each also with -x4, -x16 or -x64 appended, {}", name,
         known_are(name, known));
}

bool is_builtin_scene(const std::string& name) { return bool(parse(name, base_entries()).make); }

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
