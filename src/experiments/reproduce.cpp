// SPDX-License-Identifier: MIT
// Evaluations of several scenes, pooled view by view, and the theses' figures to put beside them.
#include "experiments/reproduce.h"

#include <algorithm>

#include <fmt/ranges.h>

#include "experiments/reproduce_views.h"
#include "experiments/statistics.h"
#include "experiments/timing.h"

namespace luxel {

namespace {

// The thesis's statements on light for one row; each names the mode.
void add_radiosity(Reproduction& out, const std::vector<ViewResult>& views, std::size_t row,
                   const std::string& mode) {
    std::vector<const ViewResult*> all;
    for (const ViewResult& view : views) all.push_back(&view);
    const Summary summary = summarize(all, row);
    const auto percent = [&](const char* subject, const char* claim, double value,
                             std::optional<bool> holds) {
        out.statements.push_back(
            {mode + ": " + subject, claim, fmt::format("{:.2f} %", value), {value}, holds});
    };
    percent("views with positive gain", "100 %", 100.0 * summary.positive,
            std::all_of(views.begin(), views.end(),
                        [&](const ViewResult& v) { return v.rows[row].figures.gain > 0; }));
    percent("gain, mean", "5.88 %", summary.mean_gain, summary.mean_gain > 0);
    percent("gain, median", "7.18 %", summary.median_gain, summary.median_gain > 0);
    out.statements.push_back({mode + ": rho before -> after",
                              ".8867 -> .8870",
                              fmt::format("{:.4f} -> {:.4f}", summary.rho_before, summary.rho_after),
                              {summary.rho_before, summary.rho_after},
                              summary.rho_after > summary.rho_before});
    percent("pixels improved", "99.05 %", 100.0 * summary.improved, std::nullopt);
}

// Numbers of another machine: none of them is an order.
void add_radiosity_times(Reproduction& out, const std::vector<ViewResult>& views, std::size_t row,
                         const std::string& mode) {
    const auto own = [&](const ViewResult& v) { return time_in_scope(v.rows[row].passes, "isr"); };
    const auto costs = over_all(views, own);
    const auto shares = over_all(views, [&](const ViewResult& v) {
        const std::optional<double> ms = own(v);
        return ms && v.rows[row].ms > 0 ? std::optional(100.0 * *ms / v.rows[row].ms) : std::nullopt;
    });
    const auto add = [&](const char* subject, const char* claim, const char* unit, int digits,
                         const std::optional<std::vector<double>>& values) {
        Statement statement = {mode + ": " + subject, claim, not_measurable, {}, std::nullopt};
        if (values) {
            statement.values = {median(*values)};
            statement.measured = fmt::format("{:.{}f} {}", statement.values[0], digits, unit);
        }
        out.statements.push_back(statement);
    };
    add("cost of a frame", "1.674 ms (HD 4870)", "ms", 3, costs);
    add("share of the frame", "19 % (138 to 112 FPS)", "%", 0, shares);
}

// Rows of one number of samples.
constexpr const char* occlusion_names[] = {"volumetric", "containment", "ssao"};
constexpr std::size_t occlusion_count = std::size(occlusion_names);
constexpr int sample_counts[] = {8, 32};

// The techniques' rows at each number of samples.
std::vector<std::string> occlusion_uses(float radius, const char* containment_membership) {
    std::vector<std::string> uses;
    for (const int samples : sample_counts) {
        const std::string common = fmt::format(":radius={},samples={}", radius, samples);
        uses.push_back("volumetric" + common);
        uses.push_back(fmt::format("containment{},membership={}", common, containment_membership));
        uses.push_back("ssao" + common);
    }
    return uses;
}

// The order of mean errors, one statement for each neighbor pair of the rows from `row` on.
void add_order(Reproduction& out, const std::vector<ViewResult>& views, std::size_t row,
               const std::string& where) {
    for (std::size_t i = 0; i + 1 < occlusion_count; ++i)
        add_order_of(out, fmt::format("{}: {} against {}", where, occlusion_names[i], occlusion_names[i + 1]),
                     mean_delta(views, row + i), mean_delta(views, row + i + 1));
}

// Each technique's own passes over those of ssao. Where views disagree on which is faster, or frames are too
// few for a median, there is no verdict.
void add_times(Reproduction& out, const std::vector<ViewResult>& views, std::size_t row, int samples,
               int frames) {
    for (std::size_t i = 0; i + 1 < occlusion_count; ++i) {
        const auto own = [&](const ViewResult& v, std::size_t k) {
            return time_in_scope(v.rows[row + k].passes, occlusion_names[k]);
        };
        const auto ratios = over_all(views, [&](const ViewResult& v) {
            const std::optional<double> ms = own(v, i), ssao = own(v, occlusion_count - 1);
            return ms && ssao ? std::optional(*ms / *ssao) : std::nullopt;
        });
        Statement statement = {fmt::format("{} samples: time of {} over ssao", samples, occlusion_names[i]),
                               "below 1",
                               not_measurable,
                               {},
                               std::nullopt};
        if (ratios) {
            const auto [least, most] = std::minmax_element(ratios->begin(), ratios->end());
            statement.values = {median(*ratios), *least, *most};
            statement.measured = fmt::format("{:.2f} ({:.2f} to {:.2f})", statement.values[0], *least, *most);
            if (frames >= fewest_timed_frames && (*most < 1 || *least >= 1)) statement.holds = *most < 1;
        }
        out.statements.push_back(statement);
    }
}

} // namespace

Reproduction reproduce_rohleder_2010(const ReproduceSettings& settings) {
    Reproduction out;
    std::vector<std::string> scenes = settings.scenes;
    if (scenes.empty()) scenes = {"builtin:cornell", "builtin:shapes-point", "builtin:sphere-in-box"};
    TruthSettings e = settings.truth;
    e.components = {"direct", "diffuse1"};
    gpu::Gpu gpu({.device = settings.run.device});
    const auto views =
        reproduce_views(settings, gpu, {"isr:samples=80", "isr:mode=thesis,samples=80"}, scenes, e, out);
    out.source = setting(views, scenes, settings);
    const char* modes[] = {"calibrated", "thesis"};
    for (std::size_t i = 0; i < 2; ++i) {
        add_radiosity(out, views, i + 1, modes[i]);
        add_radiosity_times(out, views, i + 1, modes[i]);
    }
    out.remarks = {
        "the thesis measured 227 images of 80 simple and 147 complex views at 1024x768, its time at "
        "48 samples; here 80 samples are timed",
        "pixels without a surface are left out here", about_times(settings)};
    return out;
}

Reproduction reproduce_umenhoffer_2009_occlusion(const ReproduceSettings& settings) {
    Reproduction out;
    std::vector<std::string> scenes = settings.scenes;
    if (scenes.empty()) scenes = {"builtin:cornell", "builtin:shapes-point"};
    gpu::Gpu gpu({.device = settings.run.device});
    ReproduceSettings untimed = settings;
    untimed.timed_frames = 1;

    // The truth's memberships: cubic as in fig. 4.8, where containment has it too; step, containment's in
    // fig. 4.11; tangent, the one whose integral `volumetric` estimates and for which the thesis takes cubic.
    struct Setting {
        Membership membership;
        const char *name, *containment;
    };
    for (const Setting& s : {Setting{Membership::cubic, "cubic", "cubic"},
                             {Membership::step, "step", "step"},
                             {Membership::tangent, "tangent", "cubic"}})
        for (const float radius : {0.3f, 0.9f}) {
            TruthSettings e = settings.truth;
            e.components = {"ao"}, e.ao_membership = s.membership, e.ao_radius = radius;
            std::vector<std::string> uses = occlusion_uses(radius, s.containment);

            // Against 32 samples, as the thesis's pictures have it, both would share the estimator's bias;
            // the truth of the same membership is the harder test.
            const bool normalization = s.membership == Membership::tangent && radius > 0.5f;
            if (normalization)
                for (const char* kind : {"wis", "analytic"})
                    uses.push_back(
                        fmt::format("volumetric:radius={},samples=4,normalization={}", radius, kind));

            const bool timed = s.membership == Membership::step && radius < 0.5f;
            const auto views = reproduce_views(timed ? settings : untimed, gpu, uses, scenes, e, out);
            out.source = setting(views, scenes, settings);
            std::size_t row = 1;
            for (const int samples : sample_counts) {
                add_order(out, views, row, fmt::format("{}, R {} m, {} samples", s.name, radius, samples));
                if (timed) add_times(out, views, row, samples, settings.timed_frames);
                row += occlusion_count;
            }
            if (normalization)
                add_order_of(out,
                             fmt::format("{}, R {} m, 4 samples: weighted against analytic normalization",
                                         s.name, radius),
                             mean_delta(views, row), mean_delta(views, row + 1));
        }
    out.remarks = {"the thesis's radii are 3 and 9 in its scene's units; here .3 and .9 meters",
                   "figures are mean absolute errors of accessibility against ray-traced occlusion with the "
                   "membership named first; containment has step there, else cubic",
                   about_times(settings) + "; median over views, in parentheses the least and the largest"};
    return out;
}

std::string format_reproduction(const Reproduction& r) {
    std::size_t subject = 0, claim = 5, measured = 8;
    for (const Statement& s : r.statements) {
        subject = std::max(subject, s.subject.size());
        claim = std::max(claim, s.claim.size());
        measured = std::max(measured, s.measured.size());
    }
    std::string text = r.source + "\n";
    const auto line = [&](const std::string& a, const std::string& b, const std::string& c,
                          const std::string& d) {
        text += fmt::format("{:<{}}  {:<{}}  {:<{}}  {}\n", a, subject, b, claim, c, measured, d);
    };
    line("", "claim", "measured", "holds");
    for (const Statement& s : r.statements)
        line(s.subject, s.claim, s.measured, !s.holds ? "-" : *s.holds ? "yes" : "no");
    for (const std::string& remark : r.remarks) text += "- " + remark + "\n";
    return text;
}

} // namespace luxel
