// SPDX-License-Identifier: MIT
#include "experiments/result_files.h"

#include <set>

#include <fmt/format.h>

#include "core/file.h"
#include "core/image_io.h"
#include "core/metrics.h"
#include "experiments/json_text.h"
#include "experiments/page_pictures.h"
#include "experiments/page_view.h"
#include "experiments/picture_settings.h"
#include "experiments/pictures.h"
#include "experiments/report.h"
#include "experiments/results_csv.h"
#include "experiments/results_json.h"
#include "reference/estimate_io.h"

namespace luxel {

namespace {

std::map<std::string, std::string> exr_metadata(const ViewPictures& p, const std::string& what) {
    return {{attribute::version, LUXEL_VERSION},
            {attribute::view, p.result.camera.name},
            {attribute::camera, camera_text(p.result.camera)},
            {"luxel.image", what},
            {"luxel.exposure", fmt::format("{}", p.target.exposure)}};
}

} // namespace

PictureFiles::PictureFiles(std::filesystem::path folder, const Experiment& experiment)
    : folder_(std::move(folder)), mode_(experiment.pictures), page_width_(experiment.picture_width),
      many_scenes_(experiment.scenes.size() > 1) {
    std::set<std::string> taken = {"reference"};
    for (const TechniqueRow& row : parse_uses(experiment.uses)) {
        const std::string stem = file_name_of(row.label);
        std::string name = stem;
        for (int n = 2; !taken.insert(name).second; ++n) name = fmt::format("{}-{}", stem, n);
        file_names_.push_back(name);
    }
}

void PictureFiles::write(const std::filesystem::path& folder, const ViewPictures& p) const {
    std::filesystem::create_directories(folder);
    // With its groups of samples, so that diff takes its noise out as evaluation does.
    Layers reference = {{"", p.target.radiance}, {"mask", p.target.mask}};
    for (std::size_t g = 0; g < p.target.quarters.size(); ++g)
        reference[group_layer("", int(g))] = p.target.quarters[g].radiance;
    std::map<std::string, std::string> metadata = exr_metadata(p, "reference");
    metadata[attribute::spp] = fmt::format("{}", p.result.reference_spp);
    write_exr(folder / "reference.exr", reference, metadata);
    write_png(folder / "reference.png", p.target.shown);
    for (std::size_t i = 0; i < p.rows.size(); ++i) {
        if (!p.result.rows[i].unmeasured.empty()) continue; // it would be the baseline's
        const Image& shown = p.rows[i].shown;
        write_exr(folder / (file_names_[i] + ".exr"), {{"", p.rows[i].radiance}},
                  exr_metadata(p, file_names_[i]));
        write_png(folder / (file_names_[i] + ".png"), shown);
        write_png(folder / (file_names_[i] + "-difference.png"), difference_picture(p.target.shown, shown));
    }
}

nlohmann::ordered_json PictureFiles::add(const SceneEntry& entry, const ViewPictures& p) const {
    if (mode_ == PictureMode::none) return nullptr;
    if (mode_ == PictureMode::files)
        write(folder_ / "images" / (many_scenes_ ? file_name_of(entry.name) : "") /
                  file_name_of(p.result.camera.name),
              p);

    return page_view(p, page_width_);
}

void write_results(const std::filesystem::path& folder, const ExperimentResult& result) {
    const nlohmann::ordered_json json = to_json(result);
    write_file(folder / "results.csv", results_csv(result));
    write_file(folder / "results.json", dump(json) + "\n");
    write_file(folder / "report.html", report_page(json, page_pictures(result)));
}

} // namespace luxel
