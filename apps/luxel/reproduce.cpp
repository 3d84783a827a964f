// SPDX-License-Identifier: MIT
// luxel reproduce: a thesis's claims beside measurements.
#include <cstdio>

#include <fmt/ranges.h>

#include "core/error.h"
#include "experiments/output_folder.h"
#include "experiments/reproduce.h"
#include "options.h"

namespace luxel::app {

namespace {

struct Options {
    std::string thesis, size = "192x144";
    int chapter = 0;
    CacheChoice cache;
    ReproduceSettings settings;
};

using Reproduce = Reproduction (*)(const ReproduceSettings&);

// What there is, by thesis and chapter; the first of a thesis where none is named.
struct Known {
    const char* thesis;
    int chapter;
    Reproduce reproduce;
};
constexpr Known all_known[] = {{"rohleder-2010", 5, reproduce_rohleder_2010},
                               {"umenhoffer-2009", 3, reproduce_umenhoffer_2009_diffuse},
                               {"umenhoffer-2009", 4, reproduce_umenhoffer_2009_occlusion},
                               {"umenhoffer-2009", 5, reproduce_umenhoffer_2009_reflections},
                               {"umenhoffer-2009", 6, reproduce_umenhoffer_2009_caustics},
                               {"le-2014", 4, reproduce_le_2014}};

// "rohleder-2010 (chapter 5), ..."
std::string known_theses() {
    std::vector<std::string> theses, chapters;
    for (std::size_t i = 0; i < std::size(all_known); ++i) {
        chapters.push_back(std::to_string(all_known[i].chapter));
        const bool last =
            i + 1 == std::size(all_known) || std::string_view(all_known[i].thesis) != all_known[i + 1].thesis;
        if (!last) continue;
        theses.push_back(fmt::format("{} (chapter {})", all_known[i].thesis, fmt::join(chapters, ", ")));
        chapters.clear();
    }
    return fmt::format("{}", fmt::join(theses, ", "));
}

Reproduce find(const Options& o) {
    std::vector<std::string> names;
    for (const Known& known : all_known) {
        if (o.thesis == known.thesis && (o.chapter == 0 || o.chapter == known.chapter))
            return known.reproduce;
        names.push_back(fmt::format("{} --chapter {}", known.thesis, known.chapter));
    }
    fail(Fault::usage, "reproduce: nothing of {} chapter {}; known are {}", o.thesis, o.chapter,
         fmt::join(names, ", "));
}

void run(const Options& o, const Global& global) {
    const Reproduce reproduce = find(o);
    ReproduceSettings settings = o.settings;
    const Size size = parse_size(o.size);
    settings.width = size.width, settings.height = size.height;
    settings.run.quiet = global.quiet;
    settings.strict = global.strict;
    settings.data = global.data;
    settings.run.cache = o.cache.path();
    const Reproduction result = reproduce(settings);
    print_warnings(result.warnings);

    if (!global.json) {
        fmt::print("{}", format_reproduction(result));
        return;
    }
    nlohmann::ordered_json json = {{"thesis", o.thesis},
                                   {"source", result.source},
                                   {"statements", nlohmann::ordered_json::array()},
                                   {"remarks", result.remarks}};
    for (const Statement& s : result.statements)
        json["statements"].push_back(
            {{"subject", s.subject},
             {"claim", s.claim},
             {"measured", s.measured},
             {"values", s.values},
             {"holds", s.holds ? nlohmann::ordered_json(*s.holds) : nlohmann::ordered_json()}});
    print_json(json);
}

} // namespace

void add_reproduce(CLI::App& app, const Global& global) {
    auto o = std::make_shared<Options>();
    TruthSettings& truth = o->settings.truth;
    CLI::App* command = app.add_subcommand("reproduce", "Print a thesis's claims beside measurements");
    command->add_option("thesis", o->thesis, known_theses())->required();
    command->add_option("--chapter", o->chapter, "Where the thesis has several; the first of them by default")
        ->check(CLI::Range(1, 99));
    command->add_option("--scene", o->settings.scenes, "Instead of built-in scenes; may be repeated")
        ->allow_extra_args(false);
    command
        ->add_option("--views-per-scene", o->settings.views_per_scene,
                     "Drawn by seed; 0: the cameras of the scenes")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    command->add_option("--size", o->size, "Pixels, WIDTHxHEIGHT")->capture_default_str();
    command->add_option("--spp", truth.spp, "Samples a pixel of the truth")
        ->check(CLI::Range(4, 1 << 20))
        ->capture_default_str();
    command->add_option("--frames", o->settings.timed_frames, "Timed frames of each row, in turn")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    command->add_option("--seed", truth.seed, "Of drawn views and of the truth")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_option("--device", o->settings.run.device,
                        "GPU by number or part of its name; see luxel devices");
    add_cache_options(*command, o->cache);
    command->footer(
        "The last column is the verdict on a sign or an order that the thesis claims; numbers "
        "alone have none.\n"
        "Truths are stored, so that a run that was cut off goes on where it was.\n"
        "Example: luxel reproduce rohleder-2010\n"
        "         luxel reproduce umenhoffer-2009 --chapter 4 --views-per-scene 4 --json\n"
        "         luxel reproduce le-2014 --scene scenes/sponza_pools.toml --views-per-scene 0 --data DIR");
    command->callback([o, &global] { run(*o, global); });
}

} // namespace luxel::app
