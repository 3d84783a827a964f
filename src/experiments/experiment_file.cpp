// SPDX-License-Identifier: MIT
#include "experiments/experiment_file.h"

#include <algorithm>
#include <set>

#include "core/closest.h"
#include "core/error.h"
#include "experiments/components.h"
#include "experiments/judge.h"
#include "scene/camera_file.h"
#include "scene/printable.h"
#include "scene/scene_file_section.h"

namespace luxel {

namespace {

constexpr int most_views = 10000;
constexpr std::size_t most_rows = 1000;
constexpr int largest_int = 1 << 30;

using Values = std::vector<std::pair<std::string, std::string>>;

// Runs what has no line of its own to name, with the line of `key`.
template <class Work> auto at_key(const Section& section, std::string_view key, Work work) {
    try {
        return work();
    } catch (const Error& e) {
        section.reject(key, e.what());
    }
}

// Where the paths of a file begin.
struct Roots {
    std::filesystem::path folder, data; // of the experiment file; of what begins with "data:"
};

std::string existing_file(const Section& section, std::string_view key, const std::string& path,
                          const Roots& roots) {
    constexpr std::string_view prefix = "data:";
    const bool in_data = path.starts_with(prefix);
    if (in_data && roots.data.empty())
        section.reject(
            key, fmt::format("\"{}\" needs --data DIR, or LUXEL_DATA in the environment", printable(path)));
    const std::filesystem::path file =
        in_data ? roots.data / path.substr(prefix.size()) : roots.folder / path;
    if (!std::filesystem::is_regular_file(file))
        section.reject(key, fmt::format("\"{}\" does not exist", printable(file.string())));
    return file.string();
}

std::string scene_file(const Section& section, const std::string& source, const Roots& roots) {
    if (!source.starts_with("builtin:")) return existing_file(section, "source", source, roots);
    if (is_builtin_scene(source.substr(8))) return source;
    std::vector<std::string> known;
    for (const BuiltinScene& scene : builtin_scenes()) known.push_back(scene.name);
    section.reject("source",
                   fmt::format("no scene \"{}\"; {}", printable(source), known_are(source.substr(8), known)));
}

void set_size(Section& section, ViewGroup& group) {
    const auto size = section.text("size");
    if (!size) return;
    int width = 0, height = 0;
    char rest = 0;
    if (std::sscanf(size->c_str(), "%6dx%6d%c", &width, &height, &rest) != 2 || width < 1 || height < 1 ||
        width > max_image_side || height > max_image_side)
        section.reject("size",
                       fmt::format("\"size\" must be \"WIDTHxHEIGHT\", each from 1 to {}", max_image_side));
    group.width = width, group.height = height;
}

ViewGroup read_views(Section& section, const Roots& roots, int seed, const ViewGroup& defaults) {
    ViewGroup group = defaults;
    group.choice.drawn = section.integer("count", 1, most_views).value_or(0);
    group.choice.seed = std::uint32_t(section.integer("seed", 0, largest_int).value_or(seed));
    group.choice.names = section.texts("names");
    if (const auto script = section.text("cameras")) {
        if (group.choice.drawn > 0) section.reject("cameras", "give \"count\" or \"cameras\", not both");
        group.choice.file = existing_file(section, "cameras", *script, roots);
        check_camera_file(group.choice.file);
    }
    if (section.has("seed") && group.choice.drawn == 0)
        section.reject("seed", "\"seed\" is of drawn views; it needs \"count\"");
    set_size(section, group);
    section.finish();
    return group;
}

// The warnings that come of it.
std::vector<std::string> set_frame(Section& section, FrameOptions& frame) {
    Values values;
    for (const auto& [key, texts] : section.values("frame")) {
        if (texts.size() > 1) section.reject("frame", fmt::format("\"{}\" has several values", key));
        values.emplace_back(key, texts[0]);
    }
    at_key(section, "frame", [&] { set_parameters(frame, "frame", values); });
    return idle_parameters(frame, "frame", values);
}

SceneEntry read_scene(Section& section, const Roots& roots, const Experiment& experiment,
                      const FrameOptions& frame, const ViewGroup& defaults) {
    SceneEntry entry;
    entry.source = section.required_text("source");
    entry.file = scene_file(section, entry.source, roots);
    entry.name = section.text("name").value_or(entry.source.starts_with("builtin:")
                                                   ? entry.source.substr(8)
                                                   : std::filesystem::path(entry.file).stem().string());
    entry.group = section.text("group").value_or(entry.name);
    if (const auto environment = section.text("environment"))
        entry.load.environment =
            *environment == "sky" ? *environment : existing_file(section, "environment", *environment, roots);
    entry.load.data = roots.data.string();
    entry.load.environment_scale = section.number("environment_scale", 0, 1e6).value_or(1.0f);
    entry.frame = frame;
    entry.warnings = set_frame(section, entry.frame);
    for (Section& views : section.sections("views"))
        entry.views.push_back(read_views(views, roots, experiment.truth.seed, defaults));
    if (entry.views.empty()) entry.views.push_back(defaults); // the scene's own cameras
    section.finish();
    return entry;
}

// Cartesian product of the lists, the last one fastest.
std::vector<std::string> read_technique(Section& section) {
    std::vector<std::string> uses = {section.required_text("use")};
    for (const auto& [key, texts] : section.values("sweep")) {
        std::vector<std::string> longer;
        for (const std::string& use : uses)
            for (const std::string& text : texts)
                longer.push_back(
                    at_key(section, "sweep", [&, &name = key] { return with_parameter(use, name, text); }));
        uses = std::move(longer);
        if (uses.size() > most_rows) section.reject("sweep", fmt::format("more than {} rows", most_rows));
    }
    for (const std::string& use : uses)
        if (use != baseline_name && use != all_uses) at_key(section, "use", [&] { parse_use(use); });
    section.finish();
    return uses;
}

void set_judge(Section& section, TruthSettings& truth) {
    const std::string judge = section.text("judge").value_or("reference");
    if (judge == "reference") return;
    if (judge != "povray") section.reject("judge", "\"judge\" must be \"reference\" or \"povray\"");
    truth.judge = Judge::povray;
    if (!povray_judges(truth.components))
        section.reject("judge", "the judge \"povray\" renders the components \"direct\" and "
                                "\"direct+diffuse1\" alone");
    if (section.has("spp")) section.reject("spp", "\"spp\" is of the judge \"reference\"");
}

TruthSettings read_truth(Section& section, int seed) {
    TruthSettings truth;
    truth.seed = seed;
    if (const auto text = section.text("component"))
        truth.components = at_key(section, "component", [&] { return parse_components(*text); });
    set_judge(section, truth);
    truth.spp = section.integer("spp", 4, 1 << 20).value_or(truth.spp);

    ReferenceSettings reference;
    Values values;
    if (const auto radius = section.number("ao_radius", 1e-6, 1e6))
        values.emplace_back("ao_radius", fmt::format("{}", *radius));
    if (const auto membership = section.text("ao_membership"))
        values.emplace_back("ao_membership", *membership);
    if (!values.empty() && !is_accessibility(truth.components))
        section.reject(values[0].first, fmt::format("\"{}\" is of the component \"ao\"", values[0].first));
    at_key(section, "ao_membership", [&] { set_parameters(reference, "truth", values); });
    truth.ao_radius = reference.ao_radius, truth.ao_membership = reference.ao_membership;

    const std::string lights = section.text("reference_lights").value_or("same");
    if (lights != "same" && lights != "true")
        section.reject("reference_lights", "\"reference_lights\" must be \"same\" or \"true\"");
    truth.true_environment = lights == "true";
    section.finish();
    return truth;
}

PictureMode read_pictures(Section& top) {
    const std::string mode = top.text("pictures").value_or("page");
    if (mode == "none") return PictureMode::none;
    if (mode == "page") return PictureMode::page;
    if (mode == "files") return PictureMode::files;
    top.reject("pictures", "\"pictures\" must be \"none\", \"page\" or \"files\"");
}

void require_different_names(const Section& top, const std::vector<SceneEntry>& scenes) {
    std::set<std::string> names;
    for (const SceneEntry& entry : scenes)
        if (!names.insert(file_name_of(entry.name)).second)
            top.reject("scene", fmt::format("two scenes are called \"{}\"; give each a \"name\"",
                                            printable(entry.name)));
}

} // namespace

Experiment load_experiment_file(const std::filesystem::path& file, const std::filesystem::path& data) {
    const toml::table table = parse_toml(file);
    const Roots roots{file.parent_path(), data};
    Section top(table, file.string(), "");

    Experiment e;
    e.name = top.text("name").value_or(file.stem().string());
    const int seed = top.integer("seed", 0, largest_int).value_or(1);
    e.timed_frames = top.integer("frames", 1, 10000).value_or(e.timed_frames);
    e.pictures = read_pictures(top);
    e.picture_width = top.integer("picture_width", 16, max_image_side).value_or(e.picture_width);
    e.truth.seed = seed;
    if (auto section = top.section("truth")) e.truth = read_truth(*section, seed);

    for (Section& section : top.sections("technique"))
        for (std::string& use : read_technique(section)) e.uses.push_back(std::move(use));
    at_key(top, "technique", [&] { parse_uses(e.uses); });

    FrameOptions frame;
    set_frame(top, frame);
    ViewGroup defaults;
    set_size(top, defaults);
    for (Section& section : top.sections("scene"))
        e.scenes.push_back(read_scene(section, roots, e, frame, defaults));
    top.finish();
    if (e.scenes.empty()) top.reject("scene", "there is no [[scene]]");
    require_different_names(top, e.scenes);
    return e;
}

} // namespace luxel
