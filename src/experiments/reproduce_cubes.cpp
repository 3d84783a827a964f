// SPDX-License-Identifier: MIT
// Chapters on distance cube maps: reflections and refractions, caustics.
#include <fmt/format.h>

#include "experiments/reproduce_views.h"
#include "experiments/statistics.h"

namespace luxel {

namespace {

// Rows over the views that the settings ask for, or else over the cameras of one's own scenes.
std::vector<ViewResult> measure(Reproduction& out, const ReproduceSettings& given,
                                const std::vector<std::string>& scenes,
                                const std::vector<std::string>& components,
                                const std::vector<std::string>& uses) {
    ReproduceSettings settings = given;
    if (settings.scenes.empty()) settings.scenes = scenes, settings.views_per_scene = 0;
    TruthSettings truth = settings.truth;
    truth.components = components;
    gpu::Gpu gpu({.device = settings.run.device});
    const auto views = reproduce_views(settings, gpu, uses, settings.scenes, truth, out);
    out.source = setting(views, settings.scenes, settings);
    return views;
}

} // namespace

Reproduction reproduce_umenhoffer_2009_diffuse(const ReproduceSettings& settings) {
    Reproduction out;
    // Tables 3.1 and 3.2: frames a second.
    struct Entry {
        const char* estimator;
        int texels;
        double gtx260, gt7900;
    };
    constexpr Entry entries[] = {{"classic", 4, 850, 600}, {"point", 4, 100, 60},  {"polygon", 4, 50, 11},
                                 {"classic", 2, 850, 600}, {"point", 2, 400, 150}, {"polygon", 2, 150, 80}};
    std::vector<std::string> uses;
    for (const Entry& e : entries)
        uses.push_back(fmt::format("envmap:estimator={},texels={}", e.estimator, e.texels));
    const auto views =
        measure(out, settings, {"builtin:ball-room-face-0.02"}, {"direct", "diffuse1_unoccluded"}, uses);
    for (const std::size_t first : {0, 3})
        for (const std::size_t i : {first + 1, first + 2})
            add_time_ratio(out, settings, views, {"envmap: envmap/gather", ""},
                           fmt::format("{0}x{0} texels: time of {1} over classic", entries[i].texels,
                                       entries[i].estimator),
                           fmt::format("{:.1f} (GTX 260), {:.1f} (7900 GT)",
                                       entries[first].gtx260 / entries[i].gtx260,
                                       entries[first].gt7900 / entries[i].gt7900),
                           i + 1, first + 1);
    for (const std::size_t first : {0, 3}) {
        const double polygon = mean_delta(views, first + 3), point = mean_delta(views, first + 2);
        add_order_of(out,
                     fmt::format("{0}x{0} texels, near a wall: polygon against point", entries[first].texels),
                     polygon, point);
    }
    out.remarks = {
        "the thesis's frames a second are of whole frames; here times are of the passes that shade the "
        "object",
        "errors are means of display values against direct light and one unoccluded diffuse bounce",
        about_times(settings)};
    return out;
}

Reproduction reproduce_umenhoffer_2009_reflections(const ReproduceSettings& settings) {
    Reproduction out;
    // Fig. 5.5, with the thesis's layers, then depths.
    std::vector<std::string> uses;
    struct Steps {
        int linear, secant;
    };
    constexpr Steps steps[] = {{15, 1}, {15, 10}, {80, 1}, {80, 10}};
    for (const Steps& s : steps)
        uses.push_back(
            fmt::format("distance_map:near=faces,depth=8,linear={},refine={}", s.linear, s.secant));
    const std::size_t first_depth = uses.size() + 1;
    constexpr int depths[] = {1, 2, 3, 4, 8};
    for (const int depth : depths) uses.push_back(fmt::format("distance_map:near=faces,depth={}", depth));

    const auto views = measure(out, settings, {"builtin:teapot-box", "builtin:glass-metal"},
                               {"direct", "reflections"}, uses);
    const auto name = [&](std::size_t i) { return fmt::format("{}/{}", steps[i].linear, steps[i].secant); };
    for (const auto& [better, worse] : {std::pair<std::size_t, std::size_t>{1, 0}, {2, 0}, {3, 1}, {3, 2}}) {
        add_order_of(out, fmt::format("linear/secant steps {} against {}", name(better), name(worse)),
                     mean_delta(views, better + 1), mean_delta(views, worse + 1));
    }
    for (std::size_t i = 1; i < std::size(depths); ++i)
        add_time_ratio(out, settings, views, {"distance_map: ", ""},
                       fmt::format("time at depth {} over depth 1", depths[i]), "little above 1",
                       first_depth + i, first_depth);
    out.remarks = {
        "figures are mean errors of display values against direct light and reflections up to depth 8",
        "layers are front sides, back sides and all else, as the thesis ran; cubes of 256 where it had 512",
        about_times(settings)};
    return out;
}

Reproduction reproduce_umenhoffer_2009_caustics(const ReproduceSettings& settings) {
    Reproduction out;
    // Table 6.1: along one row, then along one column.
    struct Entry {
        int photons, cube;
        double frames_per_second;
    };
    constexpr Entry entries[] = {{32, 256, 280}, {64, 256, 165}, {128, 256, 60}, {256, 256, 16},
                                 {128, 64, 63},  {128, 128, 62}, {128, 512, 60}};
    std::vector<std::string> uses;
    for (const Entry& e : entries)
        uses.push_back(fmt::format("caustic_triangles:photons={},caustic_size={}", e.photons, e.cube));
    const auto views =
        measure(out, settings, {"builtin:metal-ring", "builtin:glass-sphere"}, {"direct"}, uses);
    const auto add = [&](std::size_t row, std::size_t base, const std::string& subject) {
        add_time_ratio(
            out, settings, views, {"caustic_triangles: ", "caustic_triangles: cube: "}, subject,
            fmt::format("{:.2f}", entries[base].frames_per_second / entries[row].frames_per_second), row + 1,
            base + 1);
    };
    for (std::size_t i = 1; i < 4; ++i)
        add(i, 0, fmt::format("time of {0}x{0} photons over 32x32, cube of 256", entries[i].photons));
    for (const std::size_t i : {5, 2, 6})
        add(i, 4, fmt::format("time of a cube of {} over 64, 128x128 photons", entries[i].cube));
    out.remarks = {"the thesis's frames a second are of its whole frame; here times are of the technique, "
                   "without the capture of its distance cubes, which depends on neither",
                   about_times(settings)};
    return out;
}

} // namespace luxel
