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

Json to_json(const Difference& d, bool against_baseline) {
    const Figures& f = d.figures;
    Json json = {{"delta", f.delta},   {"rho", f.rho},   {"rmse", f.rmse},
                 {"relmse", f.relmse}, {"psnr", f.psnr}, {"ssim", f.ssim}};
    json["flip"] = to_json(d.flip, d.evaluator_flip);
    if (d.flip_hdr) json["flip_hdr"] = to_json(*d.flip_hdr, d.evaluator_flip_hdr);
    json["exposure"] = d.exposure;
    if (against_baseline)
        json.update({{"gain", f.gain}, {"improved", f.improved}, {"tied", f.tied}, {"quality", f.quality}});
    return json;
}

void print(const Json& json, const std::string& prefix) {
    for (const auto& [key, value] : json.items())
        if (value.is_object())
            print(value, prefix + key + " ");
        else
            fmt::print("{:<22}{:.6f}\n", prefix + key, value.is_null() ? INFINITY : value.get<double>());
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
    const Json json = to_json(d, baseline.has_value());
    if (global.json)
        print_json(json);
    else
        print(json, "");
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
        "Radiance is shown under the reference's exposure (98th percentile to white) for every\n"
        "metric but rmse, relmse and flip_hdr. A layer 'mask' in the reference leaves pixels out.\n"
        "evaluator_mean: FLIP's map added up in single precision, as the published evaluator does.\n"
        "Example: luxel diff truth.exr picture.exr --baseline direct.exr -o difference.png");
    command->callback([o, &global] { run(*o, global); });
}

} // namespace luxel::app
