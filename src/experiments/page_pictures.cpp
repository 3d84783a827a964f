// SPDX-License-Identifier: MIT
#include "experiments/page_pictures.h"

#include <algorithm>
#include <set>

namespace luxel {

namespace {

using Json = nlohmann::ordered_json;

std::size_t bytes_of(const Json& pictures) {
    if (pictures.is_string()) return pictures.get_ref<const std::string&>().size();
    std::size_t bytes = 0;
    if (pictures.is_structured())
        for (const Json& part : pictures) bytes += bytes_of(part);
    return bytes;
}

std::size_t best_row(const std::vector<RowResult>& mean) {
    const auto least = std::min_element(mean.begin(), mean.end(), [](const RowResult& a, const RowResult& b) {
        return a.figures.delta < b.figures.delta;
    });
    return std::size_t(least - mean.begin());
}

// Every n-th by gain, with both ends.
std::set<const ViewResult*> chosen_views(const ExperimentResult& result, std::size_t limit) {
    std::vector<const ViewResult*> views;
    std::size_t bytes = 0;
    for (const SceneResult& scene : result.scenes)
        for (const ViewResult& view : scene.views)
            if (const std::size_t size = bytes_of(view.pictures)) views.push_back(&view), bytes += size;
    if (bytes <= limit) return {views.begin(), views.end()};

    const std::size_t row = best_row(result.mean);
    std::stable_sort(views.begin(), views.end(), [&](const ViewResult* a, const ViewResult* b) {
        return a->rows[row].figures.gain < b->rows[row].figures.gain;
    });
    const std::size_t count =
        std::max(std::size_t(double(views.size()) * double(limit) / double(bytes)), std::size_t(2));
    std::set<const ViewResult*> chosen;
    for (std::size_t i = 0; i < count; ++i) chosen.insert(views[i * (views.size() - 1) / (count - 1)]);
    return chosen;
}

} // namespace

Json page_pictures(const ExperimentResult& result, std::size_t limit) {
    const std::set<const ViewResult*> chosen = chosen_views(result, limit);
    Json pictures = Json::array();
    for (const SceneResult& scene : result.scenes) {
        pictures.push_back(Json::array());
        for (const ViewResult& view : scene.views)
            pictures.back().push_back(chosen.count(&view) ? view.pictures : Json(nullptr));
    }
    return pictures;
}

} // namespace luxel
