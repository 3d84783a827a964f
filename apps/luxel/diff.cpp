// SPDX-License-Identifier: MIT
// luxel diff: every metric between two image files.
#include <cmath>
#include <cstdio>

#include "core/image_io.h"
#include "experiments/image_difference.h"
#include "experiments/output_folder.h"
#include "options.h"

namespace luxel::app {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string reference, image, baseline, output, layer;
};

Json to_json(const FlipResult& flip, double evaluator_mean) {
    return {{"mean", flip.mean},
            {"evaluator_mean", evaluator_mean},
            {"weighted_median", flip.weighted_median},
            {"max", flip.max}};
}

// JSON has neither infinity nor NaN.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json to_json(const Difference& d, bool against_baseline) {
    const Figures& f = d.figures;
    Json json = {{"delta", f.delta},           {"rho", f.rho},           {"rmse", number(f.rmse)},
                 {"relmse", number(f.relmse)}, {"psnr", number(f.psnr)}, {"ssim", number(f.ssim)}};
    json["flip"] = to_json(d.flip, d.evaluator_flip);
    if (d.flip_hdr) json["flip_hdr"] = to_json(*d.flip_hdr, d.evaluator_flip_hdr);
    json["exposure"] = d.exposure;
    if (against_baseline)
        json.update({{"gain", f.gain}, {"improved", f.improved}, {"tied", f.tied}, {"quality", f.quality}});
    if (d.noise) {
        json.update({{"delta_error", f.delta_error}, {"noise", *d.noise}});
        if (against_baseline) json["gain_error"] = f.gain_error;
    }
    json.update({{"pixels", d.pixels}, {"counted", d.counted}, {"not_finite", d.not_finite}});
    json["alpha"] = {{"differing", d.alpha.differing}, {"delta", d.alpha.delta}};
    return json;
}

void print_line(const std::string& name, double value, std::optional<double> error) {
    fmt::print("{:<23} {:.6f}", name, value);
    if (error) fmt::print(" +- {:.6f}", *error);
    fmt::print("\n");
}

void print(const FlipResult& flip, double evaluator_mean, const std::string& name) {
    for (const auto& [key, value] : {std::pair("mean", flip.mean),
                                     {"evaluator_mean", evaluator_mean},
                                     {"weighted_median", flip.weighted_median},
                                     {"max", flip.max}})
        print_line(name + " " + key, value, {});
}

// +-: the standard error that the reference's noise leaves.
void print(const Difference& d, bool against_baseline) {
    const Figures& f = d.figures;
    const auto error = [&](double value) { return d.noise ? std::optional(value) : std::nullopt; };
    print_line("delta", f.delta, error(f.delta_error));
    for (const auto& [key, value] : {std::pair("rho", f.rho),
                                     {"rmse", f.rmse},
                                     {"relmse", f.relmse},
                                     {"psnr", f.psnr},
                                     {"ssim", f.ssim}})
        print_line(key, value, {});
    print(d.flip, d.evaluator_flip, "flip");
    if (d.flip_hdr) print(*d.flip_hdr, d.evaluator_flip_hdr, "flip_hdr");
    print_line("exposure", double(d.exposure), {});
    if (against_baseline) {
        print_line("gain", f.gain, error(f.gain_error));
        for (const auto& [key, value] :
             {std::pair("improved", f.improved), {"tied", f.tied}, {"quality", f.quality}})
            print_line(key, value, {});
    }
    if (d.noise) print_line("noise", *d.noise, {});
    fmt::print("{:<23} {} of {}\n", "pixels that count", d.counted, d.pixels);
}

void run(const Options& o, const Global& global) {
    if (!o.output.empty()) check_picture_output(o.output);
    const auto baseline =
        o.baseline.empty() ? std::nullopt : std::optional<std::filesystem::path>(o.baseline);
    const Difference d = difference(o.reference, o.image, baseline, o.layer);
    if (!o.output.empty()) {
        if (o.output.ends_with(".exr"))
            write_exr(o.output, {{"", d.picture}});
        else
            write_png(o.output, d.picture);
    }
    print_warnings(d.warnings);
    if (global.json)
        print_json(to_json(d, baseline.has_value()));
    else
        print(d, baseline.has_value());
}

} // namespace

void add_diff(CLI::App& app, const Global& global) {
    auto o = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("diff", "Measure how far an image is from a reference");
    command->add_option("reference", o->reference, ".exr, .hdr (radiance), .png or .jpg (display values)")
        ->required();
    command->add_option("image", o->image, "Of the same kind and size")->required();
    command->add_option("--baseline", o->baseline, "Image that gain and improved share are counted from");
    command->add_option("--layer", o->layer, "Of the .exr files; default: the unnamed one, or the only one");
    command->add_option("-o,--output", o->output, "Picture of the negative difference, .png or .exr");
    command->footer(
        "Radiance is shown under the reference's exposure (98th percentile to white) for every metric but "
        "rmse,\n"
        "relmse and flip_hdr. A layer 'mask' of any of the files leaves pixels out of every metric.\n"
        "What the noise of a reference by luxel adds is taken out, as evaluate does; +- is what it leaves "
        "uncertain.\n"
        "Files of luxel say how they were made: other cameras, sampling, light paths are warned of.\n"
        "evaluator_mean: FLIP's map added up in single precision, as the published evaluator does.\n"
        "Example: luxel diff truth.exr picture.exr --baseline direct.exr -o difference.png");
    command->callback([o, &global] { run(*o, global); });
}

} // namespace luxel::app
