// SPDX-License-Identifier: MIT
// Photons and virtual lights in image space: times by photons, resolutions and scenes, and leaks [Le2014, ch.
// 4].
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "experiments/reproduce_views.h"
#include "experiments/timing.h"
#include "techniques/common/rsm.h"

namespace luxel {

namespace {

// Rows behind the baseline: a fourth of the photons, so many, four times as many; then as many by other ways.
enum Row : std::size_t { few = 1, march, many, at_256, lines, layers_4, layers_8, multires };
constexpr int photons[] = {2400, 9600, 38400};
const std::vector<std::string> uses = {
    "photon_map:rsm_size=1024,photons=2400,resolution=128",
    "photon_map:rsm_size=1024,photons=9600,resolution=128",
    "photon_map:rsm_size=1024,photons=38400,resolution=128",
    "photon_map:rsm_size=1024,photons=9600,resolution=256",
    "photon_map:rsm_size=1024,photons=9600,resolution=128,tracer=lines",
    "photon_map:rsm_size=1024,photons=9600,resolution=128,tracer=layers,layers=4",
    "photon_map:rsm_size=1024,photons=9600,resolution=128,tracer=layers,layers=8",
    "vpl:gather=multires,vpls=256"};
constexpr PassTimes tracing = {"photon_map: trace: ", ""};

// What tables 4.1 to 4.5 say: tracing at 256x256 over 128x128; a photon's time with 4 and with 16 times as
// many.
struct Claims {
    std::string resolution, fourfold, sixteenfold;
};
const Claims water = {"2.50, 1.90, 1.88 (table 4.4)", "1.23 (table 4.4)", "1.27 (table 4.4)"};
const Claims sponza = {"1.98 to 2.50 (Sponza, table 4.5)", "1.23 (Sponza, table 4.5)",
                       "1.31 (Sponza, table 4.5)"};
const std::map<std::string, Claims> claims_of = {{"builtin:ring", {"2.00 (table 4.1)", "", ""}},
                                                 {"builtin:occluded-ring", {"1.94 (table 4.2)", "", ""}},
                                                 {"builtin:bunnies-ring", {"2.09 (table 4.3)", "", ""}},
                                                 {"builtin:water-room", water}};

// What the light sees of mirrors and glass.
class FirstHits final : public Technique {
public:
    Slot slot() const override { return Slot::caustics; }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override {
        RsmOptions options;
        options.size = 1024;
        views_ = reflective_shadow_maps(recorder, frame, options);
        return {};
    }
    const std::vector<RsmView>& views() const { return views_; }

private:
    std::vector<RsmView> views_;
};

// Cells of the finest level of the lights' views that has at most so many with a specular pixel in them
// [Le2014, fig. 3.5]; a photon starts in each.
double cells_of(std::vector<Image> masks, int most) {
    for (;;) {
        double count = 0;
        bool finest = true;
        for (Image& mask : masks) {
            count += double(std::count_if(mask.data.begin(), mask.data.end(), [](float v) { return v > 0; }));
            finest = finest && mask.width <= 1;
        }
        if (count <= most || finest) return count;
        for (Image& mask : masks) {
            Image half(std::max(mask.width / 2, 1), std::max(mask.height / 2, 1), 1);
            for (int y = 0; y < mask.height; ++y)
                for (int x = 0; x < mask.width; ++x)
                    if (*mask.at(x, y) > 0)
                        *half.at(x * half.width / mask.width, y * half.height / mask.height) = 1;
            mask = std::move(half);
        }
    }
}

std::vector<double> count_photons(gpu::Gpu& gpu, const std::string& source, const std::string& data) {
    const Scene scene = load_scene(source, {.data = data});
    FirstHits hits;
    Renderer(gpu, scene, FrameOptions{})
        .render({.camera = scene.cameras.front(), .width = 64, .height = 64, .techniques = {&hits}});
    std::vector<Image> masks;
    for (const RsmView& view : hits.views()) {
        const Image flux = gpu.read(view.flux);
        Image mask(flux.width, flux.height, 1);
        for (std::size_t i = 0; i < mask.data.size(); ++i) {
            const float* f = &flux.data[i * std::size_t(flux.channels)];
            mask.data[i] = f[3] > 0.5f && std::max({f[0], f[1], f[2]}) > 0.0f ? 1.0f : 0.0f;
        }
        masks.push_back(std::move(mask));
    }
    std::vector<double> counts;
    for (const int most : photons) counts.push_back(cells_of(masks, most));
    return counts;
}

// Share of what a row adds to direct light that lies where the truth has none, nor near.
double leak(const ViewPictures& pictures, Row row) {
    const Image &truth = pictures.target.radiance, &base = pictures.rows[0].radiance,
                &shown = pictures.rows[row].radiance;
    const int near = std::max(truth.width / 16, 1);
    const auto lit_near = [&](int x, int y) {
        for (int v = std::max(y - near, 0); v <= std::min(y + near, truth.height - 1); ++v)
            for (int u = std::max(x - near, 0); u <= std::min(x + near, truth.width - 1); ++u)
                if (luminance(truth.rgb(u, v)) > 0.0f) return true;
        return false;
    };
    double all = 0, leaked = 0;
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) {
            const double added = double(luminance(shown.rgb(x, y) - base.rgb(x, y)));
            all += added;
            if (added > 0 && !lit_near(x, y)) leaked += added;
        }
    return all > 0 ? leaked / all : 0.0;
}

constexpr Row leaking[] = {march, lines, layers_4, layers_8};

struct SceneRun {
    std::string source;
    std::vector<ViewResult> views;
    std::vector<double> photons; // first hits with few, march, many
    std::vector<double> leaks;   // of `leaking`: means over views
};

SceneRun run_scene(const ReproduceSettings& settings, gpu::Gpu& gpu, const std::string& source,
                   Reproduction& out) {
    SceneRun run = {
        source, {}, count_photons(gpu, source, settings.data), std::vector<double>(std::size(leaking))};
    int views = 0;
    const PictureSink sink = [&](const ViewPictures& pictures) -> nlohmann::ordered_json {
        for (std::size_t i = 0; i < std::size(leaking); ++i) run.leaks[i] += leak(pictures, leaking[i]);
        ++views;
        return nullptr;
    };
    TruthSettings truth = settings.truth;
    truth.components = {"caustics"};
    run.views = reproduce_views(settings, gpu, uses, {source}, truth, out, sink);
    for (double& share : run.leaks) share /= std::max(views, 1);
    return run;
}

std::string name_of(const std::string& source) {
    return source.starts_with("builtin:") ? source.substr(8) : source;
}

// Median tracing time of one of the rows few, march and many, a photon.
std::optional<double> time_per_photon(const SceneRun& run, Row row) {
    const auto times =
        over_all(run.views, [&](const ViewResult& v) { return tracing.of(v.rows[row].passes); });
    const double count = run.photons[row - few];
    return times && count > 0 ? std::optional(median(*times) / count) : std::nullopt;
}

void add_number(Reproduction& out, const std::string& subject, const std::string& claim,
                std::optional<double> value) {
    Statement statement = {subject, claim, not_measurable, {}, std::nullopt};
    if (value) statement.measured = fmt::format("{:.2f}", *value), statement.values = {*value};
    out.statements.push_back(statement);
}

std::optional<double> over(std::optional<double> value, std::optional<double> base) {
    return value && base ? std::optional(*value / *base) : std::nullopt;
}

void add_per_photon(Reproduction& out, const SceneRun& run, Row row, const std::string& claim) {
    add_number(out,
               fmt::format("{}: time a photon, {} over {} photons", name_of(run.source),
                           run.photons[row - few], run.photons[0]),
               claim, over(time_per_photon(run, row), time_per_photon(run, few)));
}

// Tracing by resolution, by photons and by tracer, in one scene.
void add_scene(Reproduction& out, const ReproduceSettings& settings, const SceneRun& run) {
    const auto known = claims_of.find(run.source);
    const Claims& claims = known != claims_of.end() ? known->second : sponza;
    const std::string name = name_of(run.source);
    add_time_ratio(out, settings, run.views, tracing,
                   fmt::format("{}: time of tracing at 256x256 over 128x128", name), claims.resolution,
                   at_256, march);
    add_time_ratio(out, settings, run.views, tracing,
                   fmt::format("{}: time of tracing by lines over march", name), "the thesis has lines alone",
                   lines, march);
    for (const Row row : {march, many})
        add_per_photon(out, run, row, row == march ? claims.fourfold : claims.sixteenfold);

    constexpr const char* tracers[] = {"march", "lines", "4 layers", "8 layers"};
    for (std::size_t i = 0; i < std::size(leaking); ++i) {
        const bool of_thesis = run.source == "builtin:occluded-ring";
        Statement statement = {fmt::format("{}: caustics where the truth has none, {}", name, tracers[i]),
                               !of_thesis ? ""
                               : i < 2    ? "none (fig. 4.2)"
                               : i == 2   ? "leaks (fig. 4.2)"
                                          : "",
                               fmt::format("{:.2f} %", 100 * run.leaks[i]),
                               {100 * run.leaks[i]},
                               std::nullopt};
        if (of_thesis && (i == 0 || i == 2)) statement.holds = (run.leaks[i] < 0.01) == (i == 0);
        out.statements.push_back(statement);
    }
}

// Twice the frame's width and height: what is bound to pixels costs more, tracing does not.
void add_frame_sizes(Reproduction& out, const ReproduceSettings& settings, gpu::Gpu& gpu,
                     const SceneRun& small) {
    ReproduceSettings twice = settings;
    twice.width *= 2, twice.height *= 2;
    const SceneRun large = run_scene(twice, gpu, small.source, out);
    const auto add = [&](const char* subject, const char* claim, const PassTimes& times, Row row,
                         bool grows) {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < small.views.size(); ++i) {
            const auto ms = times.of(large.views[i].rows[row].passes),
                       of = times.of(small.views[i].rows[row].passes);
            if (ms && of) ratios.push_back(*ms / *of);
        }
        Statement statement = {
            fmt::format("{}: {} at twice the width and height", name_of(small.source), subject),
            claim,
            not_measurable,
            {},
            std::nullopt};
        if (!ratios.empty()) {
            statement.values = {median(ratios)};
            statement.measured = fmt::format("{:.2f}", statement.values[0]);
            if (settings.timed_frames >= fewest_timed_frames && grows)
                statement.holds = statement.values[0] > 1;
        }
        out.statements.push_back(statement);
    };
    add("splitting", "3.66 (table 4.1)", {"vpl: gather: regions: ", ""}, multires, true);
    add("gathering", "2 (table 4.1)", {"vpl: gather: vpl/gather_regions", ""}, multires, true);
    add("splatting", "1.51 (table 4.1)", {"photon_map: splat: ", ""}, march, true);
    add("tracing", "1.00 (table 4.1)", tracing, march, false);
}

} // namespace

Reproduction reproduce_le_2014(const ReproduceSettings& given) {
    Reproduction out;
    ReproduceSettings settings = given;
    const bool own = settings.scenes.empty();
    if (own) {
        settings.scenes = {"builtin:ring", "builtin:occluded-ring", "builtin:bunnies-ring",
                           "builtin:water-room"};
        settings.views_per_scene = 0;
    }
    gpu::Gpu gpu({.device = settings.run.device});
    std::vector<SceneRun> runs;
    std::vector<ViewResult> views;
    for (const std::string& source : settings.scenes) {
        runs.push_back(run_scene(settings, gpu, source, out));
        views.insert(views.end(), runs.back().views.begin(), runs.back().views.end());
        add_scene(out, settings, runs.back());
    }
    if (own) {
        const char* claims[] = {"2.43 (tables 4.1, 4.2)", "1.57 (tables 4.1, 4.3)"};
        for (const std::size_t i : {1u, 2u})
            add_number(
                out,
                fmt::format("time a photon in {} over {}", name_of(runs[i].source), name_of(runs[0].source)),
                claims[i - 1], over(time_per_photon(runs[i], march), time_per_photon(runs[0], march)));
    }
    add_frame_sizes(out, settings, gpu, runs[0]);
    out.source = setting(views, settings.scenes, settings);
    out.remarks = {
        "photons are at most 2400, 9600 and 38400, of a shadow map of 1024x1024; counted are first hits, for "
        "each of which glass sends two",
        "where the truth has none: no photon of any pass within a sixteenth of the width; shares are of the "
        "radiance that caustics add to the image",
        about_times(settings)};
    return out;
}

} // namespace luxel
