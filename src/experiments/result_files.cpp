// SPDX-License-Identifier: MIT
#include "experiments/result_files.h"

#include <set>

#include <fmt/format.h>

#include "core/file.h"
#include "core/image_io.h"
#include "core/metrics.h"
#include "experiments/json_text.h"
#include "experiments/pictures.h"
#include "experiments/report.h"
#include "experiments/results_json.h"

namespace luxel {

namespace {

constexpr int page_width = 1280;
constexpr int photo_quality = 88, map_quality = 80;

std::map<std::string, std::string> exr_metadata(const ViewPictures& p, const std::string& what) {
    return {{"luxel.version", LUXEL_VERSION},
            {"luxel.view", p.result.camera.name},
            {"luxel.image", what},
            {"luxel.exposure", fmt::format("{}", p.target.exposure)}};
}

} // namespace

ResultFiles::ResultFiles(std::filesystem::path folder, const std::vector<TechniqueRow>& rows)
    : folder_(std::move(folder)), page_pictures_(nlohmann::ordered_json::array()) {
    std::set<std::string> taken = {"reference"};
    for (const TechniqueRow& row : rows) {
        const std::string stem = file_name_of(row.label);
        std::string name = stem;
        for (int n = 2; !taken.insert(name).second; ++n) name = fmt::format("{}-{}", stem, n);
        file_names_.push_back(name);
    }
}

void ResultFiles::add(const ViewPictures& p) {
    const std::filesystem::path folder = folder_ / "images" / file_name_of(p.result.camera.name);
    std::filesystem::create_directories(folder);
    const Image& mask = p.target.mask;
    write_exr(folder / "reference.exr", {{"", p.target.radiance}, {"mask", mask}},
              exr_metadata(p, "reference"));
    write_png(folder / "reference.png", p.target.shown);

    nlohmann::ordered_json page = {{"reference", jpeg_uri(shrink(p.target.shown, page_width), photo_quality)},
                                   {"rows", nlohmann::ordered_json::array()}};
    for (std::size_t i = 0; i < p.rows.size(); ++i) {
        const Image& shown = p.rows[i].shown;
        write_exr(folder / (file_names_[i] + ".exr"), {{"", p.rows[i].radiance}},
                  exr_metadata(p, file_names_[i]));
        write_png(folder / (file_names_[i] + ".png"), shown);
        write_png(folder / (file_names_[i] + "-difference.png"), difference_picture(p.target.shown, shown));

        const Image error = error_map(p.target.shown, shown, mask);
        const Image change = change_map(p.target.shown, p.rows[0].shown, shown, mask);
        page["rows"].push_back({{"image", jpeg_uri(shrink(shown, page_width), photo_quality)},
                                {"error", jpeg_uri(shrink(error, page_width), map_quality)},
                                {"change", jpeg_uri(shrink(change, page_width), map_quality)}});
    }
    page_pictures_.push_back(std::move(page));
}

void ResultFiles::finish(const EvaluationResult& result) const {
    const nlohmann::ordered_json json = to_json(result);
    write_file(folder_ / "results.json", dump(json) + "\n");
    write_file(folder_ / "report.html", report_page(json, page_pictures_));
}

} // namespace luxel
